// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_INTERNAL_BREP_KERNEL_ERRORS_H
#define RW_SEGMENTATION_INTERNAL_BREP_KERNEL_ERRORS_H

#include <BRepCheck_Analyzer.hxx>
#include <BRepCheck_ListIteratorOfListOfStatus.hxx>
#include <BRepCheck_ListOfStatus.hxx>
#include <BRepCheck_Result.hxx>
#include <BRepCheck_Status.hxx>
#include <TopAbs_ShapeEnum.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>

#include <string>

namespace RW_segmentation::internal::brep {

/// What the kernel finds wrong, in words.
inline std::string name_of(BRepCheck_Status status) {
  switch (status) {
    case BRepCheck_InvalidPointOnCurve:
    case BRepCheck_InvalidPointOnCurveOnSurface:
    case BRepCheck_InvalidPointOnSurface:
      return "a vertex is off its edge";
    case BRepCheck_InvalidCurveOnSurface:
      return "an edge is off its surface";
    case BRepCheck_SelfIntersectingWire:
      return "its border crosses itself";
    case BRepCheck_IntersectingWires:
      return "its borders cross";
    case BRepCheck_EmptyWire:
    case BRepCheck_EmptyShell:
      return "a part of it is empty";
    case BRepCheck_NotClosed:
      return "its border is not closed";
    case BRepCheck_InvalidImbricationOfWires:
      return "its borders are not within each other";
    case BRepCheck_BadOrientationOfSubshape:
    case BRepCheck_UnorientableShape:
    case BRepCheck_BadOrientation:
      return "its orientation is wrong";
    default:
      return "the kernel's check " + std::to_string(static_cast<int>(status)) + " failed";
  }
}

/// The first thing that is wrong with a part of a shape; empty if nothing is.
inline std::string first_error(const Handle(BRepCheck_Result) & result) {
  const auto error_in = [](const BRepCheck_ListOfStatus& list) -> std::string {
    for (BRepCheck_ListIteratorOfListOfStatus it(list); it.More(); it.Next())
      if (it.Value() != BRepCheck_NoError) return name_of(it.Value());
    return "";
  };
  if (std::string error = error_in(result->Status()); !error.empty()) return error;
  for (result->InitContextIterator(); result->MoreShapeInContext(); result->NextShapeInContext())
    if (std::string error = error_in(result->StatusOnShape()); !error.empty()) return error;
  return "";
}

/// What the kernel checks.
enum class Checked {
  all,
  topology,  ///< not whether curves keep to their surfaces or cross each other, which takes most of the time
};

/// The first thing that is wrong with a shape; empty if it is valid.
inline std::string first_error(const TopoDS_Shape& shape, Checked checked = Checked::all) {
  const BRepCheck_Analyzer check(shape, checked == Checked::all);
  if (check.IsValid()) return "";
  for (const TopAbs_ShapeEnum type : {TopAbs_VERTEX, TopAbs_EDGE, TopAbs_WIRE, TopAbs_FACE, TopAbs_SHELL, TopAbs_SOLID})
    for (TopExp_Explorer part(shape, type); part.More(); part.Next())
      if (const Handle(BRepCheck_Result)& result = check.Result(part.Current()); !result.IsNull())
        if (std::string error = first_error(result); !error.empty()) return error;
  return "the kernel's check failed";
}

}  // namespace RW_segmentation::internal::brep

#endif
