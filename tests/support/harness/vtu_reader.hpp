// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// What a .pvtu file and its pieces hold, read by VTK itself.
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>

#include <filesystem>

namespace squeal::test {

/// Not collective.
inline vtkNew<vtkUnstructuredGrid> readVtu(const std::filesystem::path& file) {
  vtkNew<vtkXMLPUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkNew<vtkUnstructuredGrid> grid;
  grid->ShallowCopy(reader->GetOutput());
  return grid;
}

}  // namespace squeal::test
