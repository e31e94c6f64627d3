// Two elastic layers, deformable on deformable: convergence of frequencies and growth rates to the exact waves.
#include <gtest/gtest.h>

#include "exact/two_layers.hpp"
#include "support/case.hpp"
#include "support/spectrum.hpp"

namespace squeal::test {
namespace {

namespace two_layers = exact::two_layers;

struct Reference {
  double friction;
  std::vector<Complex> values;
};

std::vector<Reference> references(std::size_t count) {
  return {{0.1, exactValues(two_layers::friction01, count)},
          {0.3, exactValues(two_layers::friction03, count)},
          {0.5, exactValues(two_layers::friction05, count)}};
}

/// The lowest eigenvalues of the problem on all unknowns, so that no modal basis adds to the error of the mesh; [friction].
std::vector<Errors> fullOrder(const std::vector<Reference>& wanted, const std::string& mesh) {
  std::string frictions;
  for (const auto& reference : wanted) frictions += (frictions.empty() ? "" : ",") + std::to_string(reference.friction);
  const auto count = std::to_string(wanted.front().values.size() + 12);
  const Analysis analysis = runCase("two_layers", "-mesh_set " + mesh + " -elasticity_mass consistent -flutter_method direct -flutter_direct_count " + count +
                                                      " -flutter_friction " + frictions);
  std::vector<Errors> result;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    result.push_back(errors(wanted[i].values, eigenvaluesOf(analysis.segments.at(0).points.at(i))));
    print("%s, f = %g, worst of %zu: frequency %.1e, growth rate %.1e\n", mesh.c_str(), wanted[i].friction, wanted[i].values.size(),
          worst(result.back().frequency), worst(result.back().growth));
  }
  return result;
}

TEST(TwoLayers, SecondOrder) {
  const auto wanted = references(20);
  std::vector<std::vector<Errors>> found;
  for (const char* mesh : {"nx=36,ny_disc=12,ny_pad=7", "nx=72,ny_disc=24,ny_pad=14", "nx=144,ny_disc=48,ny_pad=28"})
    found.push_back(fullOrder(wanted, mesh));
  for (std::size_t i = 0; i < wanted.size(); ++i)
    for (std::size_t j = 0; j < 20; ++j)
      print("%g %zu %.4f%+.4fi freq %.2e %.2f %.2f growth %.2e %.2f %.2f\n", wanted[i].friction, j, wanted[i].values[j].real(), wanted[i].values[j].imag(),
            found[0][i].frequency[j], std::log2(found[0][i].frequency[j] / found[1][i].frequency[j]), std::log2(found[1][i].frequency[j] / found[2][i].frequency[j]),
            found[0][i].growth[j], std::log2(found[0][i].growth[j] / found[1][i].growth[j]), std::log2(found[1][i].growth[j] / found[2][i].growth[j]));
}

TEST(TwoLayers, FourthOrder) {
  const auto wanted = references(12);
  std::vector<std::vector<Errors>> found;
  for (const char* mesh : {"order=2,nx=12,ny_disc=4,ny_pad=3", "order=2,nx=24,ny_disc=8,ny_pad=6", "order=2,nx=48,ny_disc=16,ny_pad=12"})
    found.push_back(fullOrder(wanted, mesh));
  for (std::size_t i = 0; i < wanted.size(); ++i)
    for (std::size_t j = 0; j < 12; ++j)
      print("%g %zu %.4f%+.4fi freq %.2e %.2f %.2f growth %.2e %.2f %.2f\n", wanted[i].friction, j, wanted[i].values[j].real(), wanted[i].values[j].imag(),
            found[0][i].frequency[j], std::log2(found[0][i].frequency[j] / found[1][i].frequency[j]), std::log2(found[1][i].frequency[j] / found[2][i].frequency[j]),
            found[0][i].growth[j], std::log2(found[0][i].growth[j] / found[1][i].growth[j]), std::log2(found[1][i].growth[j] / found[2][i].growth[j]));
}

}  // namespace
}  // namespace squeal::test
