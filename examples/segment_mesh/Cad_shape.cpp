// SPDX-License-Identifier: MIT

// The only file of the tool that needs Open CASCADE.

#include "Cad_shape.h"

#include "../mesh_files/Segmented_soup.h"

#include <RW_segmentation/boundary_representation.h>

#include <BRepTools.hxx>
#include <IGESCAFControl_Writer.hxx>
#include <IGESControl_Controller.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Writer.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_ExtendedString.hxx>
#include <TDF_Label.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_WorkSession.hxx>

#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace segment_mesh {

namespace RW = RW_segmentation;
using Json = nlohmann::ordered_json;

namespace {

/// Open CASCADE tells of its progress on standard output, which may be a file of ours.
void silence_kernel() {
  const auto& printers = Message::DefaultMessenger()->Printers();
  for (Message_SequenceOfPrinters::Iterator it(printers); it.More(); it.Next()) it.Value()->SetTraceLevel(Message_Fail);
}

/// A document whose shapes have names and colours.
class Cad_document {
 public:
  Cad_document() {
    constexpr double millimetre = 1e-3;  // of a metre
    XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document_);
    XCAFDoc_DocumentTool::SetLengthUnit(document_, millimetre);
    shapes_ = XCAFDoc_DocumentTool::ShapeTool(document_->Main());
    colors_ = XCAFDoc_DocumentTool::ColorTool(document_->Main());
  }
  Cad_document(const Cad_document&) = delete;
  Cad_document& operator=(const Cad_document&) = delete;
  ~Cad_document() { XCAFApp_Application::GetApplication()->Close(document_); }

  const Handle(TDocStd_Document) & document() const { return document_; }

  void add(const RW::Boundary_representation& shape, const std::string& name,
           const std::vector<mesh_files::Color>& color_of_segment) {
    constexpr bool is_no_assembly = false;
    const TDF_Label label = shapes_->AddShape(shape.shape, is_no_assembly);
    set_name(label, name);
    for (const RW::Boundary_face& face : shape.faces) {
      const TDF_Label part = shapes_->AddSubShape(label, face.face);
      if (part.IsNull()) continue;
      set_name(part, mesh_files::name_of_segment(face.segment));
      colors_->SetColor(part, kernel_color(color_of_segment[face.segment]), XCAFDoc_ColorSurf);
    }
  }

 private:
  static void set_name(const TDF_Label& label, const std::string& name) {
    constexpr bool is_utf8 = true;
    TDataStd_Name::Set(label, TCollection_ExtendedString(name.c_str(), is_utf8));
  }

  static Quantity_Color kernel_color(const mesh_files::Color& color) {
    return {color[0] / 255., color[1] / 255., color[2] / 255., Quantity_TOC_sRGB};
  }

  Handle(TDocStd_Document) document_;
  Handle(XCAFDoc_ShapeTool) shapes_;
  Handle(XCAFDoc_ColorTool) colors_;
};

std::string step_content(const Cad_document& document, const std::string& name, const Length_unit& unit) {
  STEPCAFControl_Controller::Init();
  Interface_Static::SetCVal("write.step.unit", unit.kernel_name);  // before the writer, which keeps it
  Interface_Static::SetCVal("write.step.product.name", name.c_str());
  Interface_Static::SetIVal("write.stepcaf.subshapes.name", 1);
  STEPCAFControl_Writer writer;
  if (!writer.Transfer(document.document(), STEPControl_AsIs))
    throw std::runtime_error("no STEP file can be made of it");
  const Handle(StepData_StepModel) model = writer.ChangeWriter().Model();
  StepData_StepWriter text(model);
  text.SendModel(Handle(StepData_Protocol)::DownCast(model->Protocol()));
  std::ostringstream content;
  if (!text.Print(content)) throw std::runtime_error("no STEP file can be made of it");
  return content.str();
}

std::string iges_content(const Cad_document& document, const Length_unit& unit) {
  IGESControl_Controller::Init();
  Interface_Static::SetCVal("write.iges.unit", unit.kernel_name);
  constexpr int as_boundary_representation = 1;
  Interface_Static::SetIVal("write.iges.brep.mode", as_boundary_representation);
  IGESCAFControl_Writer writer;
  std::ostringstream content;
  if (!writer.Transfer(document.document()) || !writer.Write(content))
    throw std::runtime_error("no IGES file can be made of it");
  return content.str();
}

Json report_of_face(const RW::Boundary_face& face) {
  return {{"segment", face.segment},
          {"type", RW::name_of(face.type)},
          {"area", face.area},
          {"mesh_area", face.mesh_area},
          {"distance_of_mesh", face.distance_of_mesh},
          {"distance_to_mesh", face.distance_to_mesh},
          {"tolerance", face.tolerance},
          {"has_chords", face.has_chords}};
}

/// A shape of Open CASCADE.
class Kernel_shape : public Cad_shape {
 public:
  Kernel_shape(RW::Boundary_representation shape, const Length_unit& unit) : shape_(std::move(shape)), unit_(unit) {}

  std::string defect() const override { return shape_.defect(); }

  Json report() const override {
    const RW::Boundary_report& r = shape_.report;
    Json result = {{"unit", unit_.name},
                   {"defect", shape_.defect()},
                   {"valid", r.is_valid},
                   {"closed", r.is_closed},
                   {"solids", r.solids},
                   {"voids", r.voids},
                   {"open_shells", r.open_shells},
                   {"edges", r.edges},
                   {"triangles", shape_.number_of_triangles()},
                   {"area", r.area},
                   {"mesh_area", r.mesh_area},
                   {"volume", r.volume},
                   {"mesh_volume", r.mesh_volume},
                   {"refusals", Json::object()},
                   {"faces", Json::array()}};
    for (const auto& [reason, number] : r.refusals) result["refusals"][reason] = number;
    for (const RW::Boundary_face& face : shape_.faces)
      if (!face.is_triangle) result["faces"].push_back(report_of_face(face));
    return result;
  }

  std::string content(Cad_format format, const std::string& name,
                      const std::vector<mesh_files::Color>& color_of_segment) const override try {
    if (format == Cad_format::brep) {
      std::ostringstream content;
      BRepTools::Write(shape_.shape, content);
      return content.str();
    }
    Cad_document document;
    document.add(shape_, name, color_of_segment);
    return format == Cad_format::step ? step_content(document, name, unit_) : iges_content(document, unit_);
  } catch (const Standard_Failure& error) {
    throw std::runtime_error(std::string("Open CASCADE: ") + error.GetMessageString());
  }

 private:
  RW::Boundary_representation shape_;
  Length_unit unit_;
};

}  // namespace
}  // namespace segment_mesh

segment_mesh::Cad_shape* segment_mesh_new_cad_shape(const RW_segmentation::Dual_mesh& mesh,
                                                    const std::vector<std::size_t>& segment_of_face,
                                                    const std::vector<RW_segmentation::Analytic_surface>& surfaces,
                                                    const segment_mesh::Length_unit& unit,
                                                    const std::function<bool(double)>& callback) {
  segment_mesh::silence_kernel();
  return new segment_mesh::Kernel_shape(
      RW_segmentation::internal::boundary_representation(mesh, segment_of_face, surfaces, unit.millimetres,
                                                         RW_segmentation::Progress(callback)),
      unit);
}
