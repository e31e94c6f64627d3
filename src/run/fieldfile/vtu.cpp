// SPDX-License-Identifier: BSD-2-Clause
#include "run/fieldfile/vtu.hpp"

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

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <system_error>
#include <type_traits>

#include "base/output/file.hpp"
#include "base/petsc/check.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "base/system/regular_file.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"

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

// Corners and, in the plane, mid-side nodes have the same order in gmsh and VTK. In solids, gmsh
// sorts the mid-edge nodes by the corners of their edge. VTK goes around the base, then around the
// top, then along the edges in between (tetrahedra and pyramids: base, then the other edges). VTK
// has no pyramid of 14 nodes: the node in the middle of the base is omitted. The mid-face nodes of
// bricks: gmsh −z −y −x +x +y +z, VTK −x +x −y +y −z +z.
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

/// The part of a mesh and of its fields that goes into one file.
struct Piece {
  std::vector<double> coordinates;              // [node][3]
  std::vector<PetscInt> nodeTag, nodes;         // nodes: of all cells
  std::vector<int> nodePart, type, body, rank;  // type: VTKCellType, body and rank: [cell]
  bool hasSections = false;                     // a body is made up of sections
  std::vector<int> material;                    // [cell], if there are sections
  std::vector<std::vector<float>> fields;       // [field][node][component]
  std::vector<std::vector<float>> cellFields;   // [field][cell][component]
};

/// Returns the part of this rank, without reference nodes and layer nodes, which are in no cell.
Piece ownPiece(const mesh::Mesh& mesh, const std::vector<Field>& fields,
               const std::vector<Field>& cellFields, int rank) {
  Piece piece;
  for (const auto& field : cellFields)
    piece.cellFields.emplace_back(field.values.begin(), field.values.end());
  piece.hasSections = mesh.hasSections();
  std::vector<PetscInt> number(mesh.localNodes(), -1);  // in the piece
  piece.fields.resize(fields.size());
  std::vector<unsigned char> isLayer(mesh.localNodes(), 0);
  for (const auto& [node, layer] : mesh.layers) isLayer[layer] = 1;
  for (PetscInt node = 0; node < mesh.localNodes(); ++node) {
    if (isLayer[node] || mesh.referenceWith(mesh.globalNode[node])) continue;
    number[node] = std::ssize(piece.nodeTag);
    const auto& x = mesh.coordinates[node];
    piece.coordinates.insert(piece.coordinates.end(), x.begin(), x.end());
    piece.nodeTag.push_back(mesh.nodeTag[node]);
    piece.nodePart.push_back(mesh.nodePart[node]);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto first = fields[i].values.begin() + node * fields[i].components;
      piece.fields[i].insert(piece.fields[i].end(), first, first + fields[i].components);
    }
  }
  for (const auto& block : mesh.cells) {
    const auto& [type, order] = cellsByGmshType().at(block.type);
    for (std::size_t cell = 0; cell < block.body.size(); ++cell)
      for (const int i : order) piece.nodes.push_back(number[block.nodesOf(cell)[i]]);
    piece.type.insert(piece.type.end(), block.body.size(), type);
    piece.body.insert(piece.body.end(), block.body.begin(), block.body.end());
    if (piece.hasSections)
      piece.material.insert(piece.material.end(), block.material.begin(), block.material.end());
  }
  piece.rank.assign(piece.body.size(), rank);
  return piece;
}

/// Collective. Merges the pieces of all ranks on rank 0.
void gatherOnFirst(MPI_Comm comm, Piece& piece) {
  const PetscInt before = mpi::sumBefore<PetscInt>(comm, piece.nodeTag.size());
  for (auto& node : piece.nodes) node += before;
  const auto gather = [&]<class Entry>(std::vector<Entry>& list) {
    list = concatenatedOnFirst<Entry>(comm, list);
  };
  gather(piece.coordinates);
  for (auto* list : {&piece.nodeTag, &piece.nodes}) gather(*list);
  for (auto* list : {&piece.nodePart, &piece.type, &piece.body, &piece.rank, &piece.material})
    gather(*list);
  for (auto* fields : {&piece.fields, &piece.cellFields})
    for (auto& field : *fields) gather(field);
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

vtkNew<vtkUnstructuredGrid> gridOf(const Piece& piece, const std::vector<Field>& fields,
                                   const std::vector<Field>& cellFields) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(piece.nodeTag.size());
  for (std::size_t node = 0; node < piece.nodeTag.size(); ++node)
    points->SetPoint(node, &piece.coordinates[3 * node]);
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(filledArray<vtkTypeInt64Array>("node_tag", 1, piece.nodeTag));
  grid->GetPointData()->AddArray(filledArray<vtkIntArray>("part", 1, piece.nodePart));
  for (std::size_t i = 0; i < fields.size(); ++i)
    grid->GetPointData()->AddArray(
        filledArray<vtkFloatArray>(fields[i].name, fields[i].components, piece.fields[i]));
  std::map<int, int> nodesOfType;
  for (const auto& [gmsh, cell] : cellsByGmshType())
    nodesOfType[cell.type] = std::ssize(cell.order);
  std::vector<vtkIdType> nodes;
  std::size_t next = 0;
  for (const int type : piece.type) {
    const std::size_t end = next + nodesOfType[type];
    nodes.assign(piece.nodes.begin() + next, piece.nodes.begin() + end);
    grid->InsertNextCell(type, nodes.size(), nodes.data());
    next = end;
  }
  grid->GetCellData()->AddArray(filledArray<vtkIntArray>("body", 1, piece.body));
  grid->GetCellData()->AddArray(filledArray<vtkIntArray>("rank", 1, piece.rank));
  if (piece.hasSections)
    grid->GetCellData()->AddArray(filledArray<vtkIntArray>("material", 1, piece.material));
  for (std::size_t i = 0; i < cellFields.size(); ++i)
    grid->GetCellData()->AddArray(filledArray<vtkFloatArray>(
        cellFields[i].name, cellFields[i].components, piece.cellFields[i]));
  return grid;
}

/// Collective. Rank 0 creates the folder; the others wait for it.
void makeFolder(MPI_Comm comm, const fs::path& folder, const std::string& head) {
  onFirstRank(comm, head, [&] {
    const SignalsBlocked whole;
    std::error_code error;
    if (const std::string why = whyNoFolder(folder); !why.empty()) throw output::WriteError(why);
    if (!folder.empty()) fs::create_directories(folder, error);
    if (error) throw output::WriteError(output::cannotWrite(folder, error.value()));
  });
}

void requireWritable(const mesh::Mesh& mesh, const std::vector<Field>& fields,
                     const std::vector<Field>& cellFields) {
  std::string message;
  std::size_t cells = 0;
  for (const auto& block : mesh.cells) cells += block.tag.size();
  for (const auto& field : cellFields)
    if (field.values.size() != field.components * cells)
      message = formatted("field %s: %zu values of %d components do not fit %zu cells",
                          field.name.c_str(), field.values.size(), field.components, cells);
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

/// Not collective. Writes a piece. Returns the error message; empty on success.
std::string writePiece(vtkUnstructuredGrid* grid, const fs::path& path) {
  const SignalsBlocked whole;
  try {
    output::reserve(path, 0);  // VTK would follow a link, and wait for the reader of a pipe
  } catch (const output::WriteError& error) {
    return error.what();
  }
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

/// Returns the text of the file that lists the pieces. VTK's own writer truncates the stem at its
/// last dot: steady_0.2 and steady_0.4 would both use, and overwrite, the pieces of steady_0.
template <class Path>
std::string summaryText(const std::vector<Field>& fields, const std::string& cellArrays,
                        const fs::path& folder, const Path& path, int pieces) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" "
      "header_type=\"UInt64\">\n"
      "  <PUnstructuredGrid GhostLevel=\"0\">\n    <PPointData>\n" +
      arrayTag("Int64", "node_tag", 1) + arrayTag("Int32", "part", 1);
  for (const auto& field : fields) text += arrayTag("Float32", field.name, field.components);
  text += "    </PPointData>\n    <PCellData>\n" + arrayTag("Int32", "body", 1) +
          arrayTag("Int32", "rank", 1);
  text += cellArrays;
  text +=
      "    </PCellData>\n    <PPoints>\n" + arrayTag("Float64", "Points", 3) + "    </PPoints>\n";
  for (int i = 0; i < pieces; ++i)
    text +=
        "    <Piece Source=\"" + xmlText((folder / path(i).filename()).generic_string()) + "\"/>\n";
  return text + "  </PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace

void writeVtu(const mesh::Mesh& mesh, const fs::path& stem, const std::vector<Field>& pointFields,
              const std::string& option, int mostPieces, const std::vector<Field>& cellFields) {
  const std::string head = "option " + option + ": ";
  const int rank = mpi::rank(mesh.comm), size = mpi::size(mesh.comm);
  requireWritable(mesh, pointFields, cellFields);

  const auto path = [&stem](int index) {
    return stem / (stem.filename().string() + "_" + std::to_string(index) + ".vtu");
  };
  // Neighbouring ranks share a file, which the first rank writes.
  const int pieces = std::min(size, mostPieces),
            index = static_cast<std::int64_t>(rank) * pieces / size;
  Piece piece = ownPiece(mesh, pointFields, cellFields, rank);
  MPI_Comm sharing = MPI_COMM_NULL;
  check(MPI_Comm_split(mesh.comm, index, rank, &sharing));
  gatherOnFirst(sharing, piece);
  const int place = mpi::rank(sharing);
  check(MPI_Comm_free(&sharing));

  // not replace_extension(): the dot of a stem such as steady_0.4 does not start an extension
  const fs::path summary = stem.string() + ".pvtu";
  makeFolder(mesh.comm, stem, head);
  const std::string failure =
      place == 0 ? writePiece(gridOf(piece, pointFields, cellFields), path(index)) : "";
  failTogether(mesh.comm, failure.empty() ? "" : head + failure);
  std::string cellArrays = mesh.hasSections() ? arrayTag("Int32", "material", 1) : "";
  for (const auto& field : cellFields)
    cellArrays += arrayTag("Float32", field.name, field.components);
  onFirstRank(mesh.comm, head, [&] {
    output::writeFile(summary, summaryText(pointFields, cellArrays, stem.filename(), path, pieces));
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
