// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_NAMED_PARAMETERS_H
#define RW_SEGMENTATION_INTERNAL_NAMED_PARAMETERS_H

#include <CGAL/Named_function_parameters.h>

#include <type_traits>

namespace RW_segmentation::internal {

template <class T>
struct Named_parameters : std::false_type {
  template <class... Tags>
  static constexpr bool are_among = false;
};
template <>
struct Named_parameters<CGAL::internal_np::No_property> : std::false_type {
  template <class... Tags>
  static constexpr bool are_among = true;
};
template <class T, class Tag, class Base>
struct Named_parameters<CGAL::Named_function_parameters<T, Tag, Base>> : std::true_type {
  template <class... Tags>
  static constexpr bool are_among = (std::is_same_v<Tag, CGAL::internal_np::all_default_t> || ... ||
                                     std::is_same_v<Tag, Tags>)&&Named_parameters<Base>::template are_among<Tags...>;
};

/// Whether it is a sequence of CGAL's named parameters.
template <class T>
constexpr bool is_named_parameters = Named_parameters<T>::value;

/// Whether all named parameters of a sequence have one of the tags: a name that a function does not use is not accepted
/// in silence.
template <class NamedParameters, class... Tags>
constexpr bool has_only = Named_parameters<NamedParameters>::template are_among<Tags...>;

using Vertex_point = CGAL::internal_np::vertex_point_t;
using Edge_is_constrained = CGAL::internal_np::edge_is_constrained_t;
using Callback = CGAL::internal_np::callback_t;

/// Whether all are names that stages take: points, walls and what is told the progress.
template <class NamedParameters>
constexpr bool has_only_names_of_stages = has_only<NamedParameters, Vertex_point, Edge_is_constrained, Callback>;

/// The value of a named parameter that may be missing.
template <class NamedParameters, class Tag>
constexpr bool has_parameter =
    !std::is_same_v<typename CGAL::internal_np::Get_param<typename NamedParameters::base, Tag>::type,
                    CGAL::internal_np::Param_not_found>;

/// Of named parameters the callback alone, for a function to which the rest has been of use already.
template <class NamedParameters>
auto only_callback(const NamedParameters& np) {
  if constexpr (has_parameter<NamedParameters, Callback>)
    return CGAL::parameters::callback(CGAL::parameters::get_parameter(np, CGAL::internal_np::callback));
  else
    return CGAL::parameters::default_values();
}

}  // namespace RW_segmentation::internal

#endif
