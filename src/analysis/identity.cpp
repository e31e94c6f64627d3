#include "analysis/identity.hpp"

#include <fstream>
#include <vector>

#include "options/options.hpp"
#include "petsc/concatenation.hpp"
#include "petsc/text.hpp"

namespace squeal::analysis {
namespace {

template <class Entry>
void add(unsigned long& sum, const std::vector<Entry>& entries) {
  sum = checkpoint::checksum(entries.data(), entries.size() * sizeof(Entry), sum);
}

/// Collective. Returns a checksum of those of all ranks.
std::string overAllRanks(MPI_Comm comm, unsigned long own) {
  unsigned long all = 0;
  add(all, concatenated(comm, std::vector<unsigned long>{own}));
  return formatted("checksum %08lx", all);
}

unsigned long checksumOf(const mesh::Mesh& mesh) {
  unsigned long sum = 0;
  add(sum, mesh.globalNode);
  add(sum, mesh.coordinates);
  for (const auto& block : mesh.cells) {
    add(sum, block.nodes);
    add(sum, block.body);
  }
  for (const auto& block : mesh.faces) {
    add(sum, block.nodes);
    add(sum, block.surface);
  }
  for (const auto& [name, nodes] : mesh.nodeGroups) add(sum, nodes);
  return sum;
}

unsigned long checksumOf(const std::string& path) {
  unsigned long sum = 0;
  std::ifstream file(path, std::ios::binary);
  std::vector<char> piece(1 << 20);
  while (file.read(piece.data(), std::ssize(piece)) || file.gcount() > 0)
    sum = checkpoint::checksum(piece.data(), file.gcount(), sum);
  return sum;
}

}  // namespace

checkpoint::Identity identityOfInput(const Analysis& analysis) {
  int rank = 0;
  check(MPI_Comm_rank(analysis.comm, &rank));
  if (analysis.mesh) return {{"the mesh", overAllRanks(analysis.comm, checksumOf(*analysis.mesh))}};
  checkpoint::Identity identity;
  for (const auto& [name, value] : givenOptions())
    if (FileOption::isOne(name))
      identity["the file of option -" + name] =
          overAllRanks(analysis.comm, rank == 0 ? checksumOf(value) : 0);
  return identity;
}

}  // namespace squeal::analysis
