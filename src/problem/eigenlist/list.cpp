// SPDX-License-Identifier: BSD-2-Clause
#include "problem/eigenlist/list.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

#include "base/system/error.hpp"
#include "base/system/text.hpp"
#include "problem/eigenlist/columns.hpp"
#include "problem/eigenlist/listings.hpp"

namespace squeal::eigenlist {
namespace {

/// Returns the half Im s ≥ 0. An entry of the other half is the conjugate of an entry, or stands
/// for its own.
void setUpperHalf(const std::vector<Complex>& all, List& list) {
  constexpr double same = 1e-6;  // of |s|: fewer digits than lists print
  std::vector<bool> paired(all.size(), false);
  const auto isConjugateOf = [&](Complex s, std::size_t i) {
    return all[i].imag() >= 0 && !paired[i] &&
           std::abs(all[i] - std::conj(s)) <= same * std::abs(s);
  };
  std::vector<bool> dropped(all.size(), false);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].imag() >= 0) continue;
    std::size_t i = 0;
    while (i < all.size() && !isConjugateOf(all[k], i)) ++i;
    if (i == all.size()) continue;
    paired[i] = dropped[k] = true;
    ++list.conjugates;
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (dropped[k]) continue;
    const bool isMirrored = all[k].imag() < 0;
    list.values.push_back(isMirrored ? std::conj(all[k]) : all[k]);
    list.numbers.push_back(static_cast<long>(k) + 1);
    list.mirrored += isMirrored;
  }
}

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error("the file cannot be read");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) throw Error("the file cannot be read");
  if (text.find('\0') != std::string::npos) throw Error("this is not a text file");
  return text;
}

}  // namespace

List parse(std::string_view text, Format format, std::optional<Unit> unit) {
  const auto lines = linesOf(text);
  if (lines.empty()) throw Error("the file is empty");
  if (format == Format::automatic) format = formatOf(lines);
  List list;
  std::vector<Complex> all;
  if (format == Format::columns) {
    all = columns(lines, unit, list.layout);
  } else {
    if (unit)
      throw Error("the listing states its units (" + layoutOf(format) +
                  "); leave -referee_unit out");
    list = listed(lines, format);
    all = std::exchange(list.values, {});
    list.layout = layoutOf(format);
  }
  if (all.empty()) throw Error("no eigenvalue was found (" + list.layout + ")");
  setUpperHalf(all, list);
  return list;
}

List read(MPI_Comm comm, const Settings& settings) {
  List list;
  onFirstRank(comm, "option " + listOption() + ": " + settings.file + ": ",
              [&] { list = parse(contentOf(settings.file), settings.format, settings.unit); });
  mpi::broadcast(comm, list.values);
  mpi::broadcast(comm, list.numbers);
  mpi::broadcast(comm, list.layout);
  mpi::broadcast(comm, list.conjugates);
  mpi::broadcast(comm, list.mirrored);
  mpi::broadcast(comm, list.skipped);
  return list;
}

}  // namespace squeal::eigenlist
