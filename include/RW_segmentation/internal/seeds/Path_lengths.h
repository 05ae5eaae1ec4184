// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_SEEDS_PATH_LENGTHS_H
#define RW_SEGMENTATION_INTERNAL_SEEDS_PATH_LENGTHS_H

#include <RW_segmentation/Dual_graph.h>

#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/filtered_graph.hpp>
#include <boost/graph/two_bit_color_map.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>

#include <functional>
#include <limits>
#include <vector>

namespace RW_segmentation::internal {

/// The lengths of the shortest paths over a dual graph from a growing set of source faces, by Boost's Dijkstra;
/// infinite where no path leads,
/// negative at the sources themselves.
class Path_lengths {
 public:
  using Index = Dual_graph::Index;

  /// Keeps references to both arguments. `edge_length` is in the order of the edges, none is negative; no path
  /// leads over an infinite one.
  Path_lengths(const Dual_graph& graph, const std::vector<double>& edge_length)
      : graph_(graph),
        edge_length_(edge_length),
        length_(graph.number_of_faces(), std::numeric_limits<double>::infinity()),
        colour_(graph.number_of_faces()) {}

  double operator[](Index face) const { return length_[face]; }
  const std::vector<double>& operator*() const { return length_; }

  /// Adds all sources in one run, which sees only those arcs that shorten a path: it visits the faces that come closer
  /// and their neighbours, no others.
  void add_sources(const std::vector<Index>& sources) {
    for (const Index source : sources) length_[source] = 0;
    const boost::filtered_graph shortening(graph_, Shortens{edge_length_.data(), length_.data()});
    const auto length_of_arc = boost::make_function_property_map<Dual_graph::Arc>(
        [this](const Dual_graph::Arc& arc) { return edge_length_[arc.edge]; });
    const auto length_of_path = boost::make_iterator_property_map(length_.begin(), index_);
    boost::dijkstra_shortest_paths_no_init(shortening, sources.begin(), sources.end(), boost::dummy_property_map(),
                                           length_of_path, length_of_arc, index_, std::less<double>(),
                                           std::plus<double>(), 0., Whiten{colour_}, colour_);
    for (const Index source : sources) length_[source] = -1;
  }

 private:
  using Index_map = boost::typed_identity_property_map<Index>;
  using Colour_map = boost::two_bit_color_map<Index_map>;

  struct Shortens {
    const double *edge_length, *length;
    bool operator()(const Dual_graph::Arc& arc) const {
      return length[arc.source] + edge_length[arc.edge] < length[arc.target];
    }
  };

  /// Leaves the colours as the next run wants them. No arc shortens the path to a finished face.
  struct Whiten : boost::dijkstra_visitor<> {
    Colour_map colour;
    explicit Whiten(const Colour_map& map) : colour(map) {}
    template <class Graph>
    void finish_vertex(Index face, const Graph&) {
      put(colour, face, boost::two_bit_white);
    }
  };

  const Dual_graph& graph_;
  const std::vector<double>& edge_length_;
  std::vector<double> length_;
  Index_map index_;
  Colour_map colour_;
};

}  // namespace RW_segmentation::internal

#endif
