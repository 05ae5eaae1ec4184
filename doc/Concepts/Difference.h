/// \cgalConcept Difference
///
/// How different the two faces of an edge are: what the walk should not cross, what distances between seeds add up, and
/// what regions are kept apart by.
///
/// A difference is nothing but a readable property map from the mesh's `edge_descriptor` to a number >= 0 that converts
/// to `double`. Only interior edges are asked, each once by every stage, so that `get()` may be slow. What matters are
/// ratios: `Conductance` divides by sigma, so a difference should average about 1 over the edges (Eq. 5).
///
/// \cgalModels `RW_segmentation::Dihedral_difference`, a stored `Surface_mesh::Property_map<Edge_index, double>`, a lambda in
/// `boost::make_function_property_map`; `examples/own_difference.cpp` shows three of a user's own.
class Difference {};
