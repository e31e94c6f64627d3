#include "fieldfile/vtu.hpp"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkErrorCode.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <map>
#include <numeric>
#include <system_error>

#include "output/file.hpp"
#include "petsc/check.hpp"
#include "petsc/termination.hpp"
#include "petsc/text.hpp"

namespace squeal::fieldfile {
namespace {

namespace fs = std::filesystem;

/// The VTK cell of a gmsh element type.
struct VtkCell {
  int type;                ///< VTKCellType
  std::vector<int> order;  ///< [VTK node] node of the gmsh element
};

std::vector<int> sameOrder(int nodes) {
  std::vector<int> order(nodes);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

// Corners and, in the plane, mid-side nodes have the same order in gmsh and VTK. In solids gmsh
// sorts the mid-edge nodes by the corners of their edge, VTK walks round the base, then round the
// top, then up the edges between (tetrahedra and
// pyramids: base, then up). VTK has no pyramid of 14 nodes: the one in the middle of the base is
// left out. The mid-face nodes of bricks: gmsh −z
// −y −x +x +y +z, VTK −x +x −y +y −z +z.
const std::map<int, VtkCell>& cellsByGmshType() {
  static const std::map<int, VtkCell> cells{
      {2, {VTK_TRIANGLE, sameOrder(3)}},
      {3, {VTK_QUAD, sameOrder(4)}},
      {4, {VTK_TETRA, sameOrder(4)}},
      {5, {VTK_HEXAHEDRON, sameOrder(8)}},
      {6, {VTK_WEDGE, sameOrder(6)}},
      {7, {VTK_PYRAMID, sameOrder(5)}},
      {9, {VTK_QUADRATIC_TRIANGLE, sameOrder(6)}},
      {10, {VTK_BIQUADRATIC_QUAD, sameOrder(9)}},
      {11, {VTK_QUADRATIC_TETRA, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}}},
      {12, {VTK_TRIQUADRATIC_HEXAHEDRON, {0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 13, 9,  16, 18,
                                          19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26}}},
      {13,
       {VTK_BIQUADRATIC_QUADRATIC_WEDGE,
        {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11, 15, 17, 16}}},
      {14, {VTK_QUADRATIC_PYRAMID, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}}},
      {16, {VTK_QUADRATIC_QUAD, sameOrder(8)}},
      {17, {VTK_QUADRATIC_HEXAHEDRON, {0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                       13, 9, 16, 18, 19, 17, 10, 12, 14, 15}}},
      {18, {VTK_QUADRATIC_WEDGE, {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11}}},
      {19, {VTK_QUADRATIC_PYRAMID, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}}},
  };
  return cells;
}

template <class Array, class Value>
vtkNew<Array> filledArray(const std::string& name, int components,
                          const std::vector<Value>& values) {
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(values.size() / components);
  for (std::size_t i = 0; i < values.size(); ++i) array->SetValue(i, values[i]);
  return array;
}

void addPoints(vtkUnstructuredGrid* grid, const mesh::Mesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(mesh.localNodes());
  for (PetscInt node = 0; node < mesh.localNodes(); ++node)
    points->SetPoint(node, mesh.coordinates[node].data());
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(filledArray<vtkTypeInt64Array>("node_tag", 1, mesh.nodeTag));
  grid->GetPointData()->AddArray(filledArray<vtkIntArray>("part", 1, mesh.nodePart));
}

void addCells(vtkUnstructuredGrid* grid, const mesh::Mesh& mesh, int rank) {
  std::vector<int> bodies;
  for (const auto& block : mesh.cells) {
    const auto& [type, order] = cellsByGmshType().at(block.type);
    std::vector<vtkIdType> nodes(order.size());
    for (std::size_t cell = 0; cell < block.body.size(); ++cell) {
      for (std::size_t i = 0; i < order.size(); ++i) nodes[i] = block.nodesOf(cell)[order[i]];
      grid->InsertNextCell(type, nodes.size(), nodes.data());
    }
    bodies.insert(bodies.end(), block.body.begin(), block.body.end());
  }
  grid->GetCellData()->AddArray(filledArray<vtkIntArray>("body", 1, bodies));
  grid->GetCellData()->AddArray(
      filledArray<vtkIntArray>("rank", 1, std::vector<int>(bodies.size(), rank)));
}

/// Collective. Rank 0 makes the folder; the others wait for it.
void makeFolder(MPI_Comm comm, const fs::path& folder, const std::string& head) {
  onFirstRank(comm, head, [&] {
    const EndingWaits whole;
    std::error_code error;
    if (!folder.empty()) fs::create_directories(folder, error);
    if (error) throw output::WriteError(output::cannotWrite(folder, error.value()));
  });
}

void requireWritable(const mesh::Mesh& mesh, const std::vector<Field>& fields) {
  std::string message;
  for (const auto& block : mesh.cells)
    if (!cellsByGmshType().contains(block.type))
      message = formatted("no VTK cell for cells of gmsh type %d", block.type);
  for (const auto& field : fields)
    if ((field.components != 1 && field.components != 3) ||
        field.values.size() != field.components * mesh.globalNode.size())
      message = formatted("field %s: %zu values of %d components do not fit %zu nodes",
                          field.name.c_str(), field.values.size(), field.components,
                          mesh.globalNode.size());
  failTogether(mesh.comm, message);
}

/// Not collective. Writes the piece of this rank. Returns what went wrong, empty if nothing did.
std::string writePiece(vtkUnstructuredGrid* grid, const fs::path& path) {
  const EndingWaits whole;
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetFileName(path.c_str());
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);  // the default, 5, takes twice as long for the same size
  const int warnings = vtkObject::GetGlobalWarningDisplay();
  vtkObject::SetGlobalWarningDisplay(0);  // our message replaces VTK's text on stderr
  const bool written = writer->Write() == 1 && writer->GetErrorCode() == vtkErrorCode::NoError;
  vtkObject::SetGlobalWarningDisplay(warnings);
  return written ? ""
                 : output::cannotWrite(path, 0) + ": " +
                       vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode());
}

std::string xmlText(const std::string& text) {
  std::string escaped;
  for (char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  }
  return escaped;
}

std::string arrayTag(const std::string& type, const std::string& name, int components) {
  return formatted("      <PDataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\"/>\n",
                   type.c_str(), xmlText(name).c_str(), components);
}

/// Returns the text of the file that names the pieces. VTK's own writer of it cuts the stem at its
/// last dot: steady_0.2 and steady_0.4 would share, and overwrite, the pieces of steady_0.
template <class Piece>
std::string summaryText(const std::vector<Field>& fields, const fs::path& folder,
                        const Piece& piece, int pieces) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" "
      "header_type=\"UInt64\">\n"
      "  <PUnstructuredGrid GhostLevel=\"0\">\n    <PPointData>\n" +
      arrayTag("Int64", "node_tag", 1) + arrayTag("Int32", "part", 1);
  for (const auto& field : fields) text += arrayTag("Float32", field.name, field.components);
  text += "    </PPointData>\n    <PCellData>\n" + arrayTag("Int32", "body", 1) +
          arrayTag("Int32", "rank", 1);
  text +=
      "    </PCellData>\n    <PPoints>\n" + arrayTag("Float64", "Points", 3) + "    </PPoints>\n";
  for (int i = 0; i < pieces; ++i)
    text += "    <Piece Source=\"" + xmlText((folder / piece(i).filename()).generic_string()) +
            "\"/>\n";
  return text + "  </PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace

void writeVtu(const mesh::Mesh& mesh, const fs::path& stem, const std::vector<Field>& pointFields,
              const std::string& option) {
  const std::string head = "option " + option + ": ";
  int rank = 0, size = 1;
  check(MPI_Comm_rank(mesh.comm, &rank));
  check(MPI_Comm_size(mesh.comm, &size));
  requireWritable(mesh, pointFields);

  vtkNew<vtkUnstructuredGrid> grid;
  addPoints(grid, mesh);
  addCells(grid, mesh, rank);
  for (const auto& field : pointFields)
    grid->GetPointData()->AddArray(
        filledArray<vtkFloatArray>(field.name, field.components, field.values));

  const auto piece = [&stem](int index) {
    return stem / (stem.filename().string() + "_" + std::to_string(index) + ".vtu");
  };
  // not replace_extension: a stem such as steady_0.4 has a dot that begins no extension
  const fs::path summary = stem.string() + ".pvtu";
  makeFolder(mesh.comm, stem, head);
  const std::string failure = writePiece(grid, piece(rank));
  failTogether(mesh.comm, failure.empty() ? "" : head + failure);
  onFirstRank(mesh.comm, head, [&] {
    output::writeFile(summary, summaryText(pointFields, stem.filename(), piece, size));
  });
}

void writePvd(MPI_Comm comm, const fs::path& path,
              const std::vector<std::pair<double, fs::path>>& frames, const std::string& option) {
  const std::string head = "option " + option + ": ";
  const fs::path folder = path.parent_path();
  makeFolder(comm, folder, head);
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const auto& [time, file] : frames)
    text += "    <DataSet timestep=\"" + shortest(time) + "\" part=\"0\" file=\"" +
            xmlText(file.lexically_proximate(folder).generic_string()) + "\"/>\n";
  text += "  </Collection>\n</VTKFile>\n";
  onFirstRank(comm, head, [&] { output::writeFile(path, text); });
}

}  // namespace squeal::fieldfile
