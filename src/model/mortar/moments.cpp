// SPDX-License-Identifier: BSD-2-Clause
#include "model/mortar/moments.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "model/mesh/vector.hpp"
#include "model/mortar/surface.hpp"

namespace squeal::mortar {

using mesh::plus;

namespace {

using linalg::DenseMatrix;

void addSlave(FaceMoments& sums, const NodeValues& phi, const OverlapPoint& point) {
  const PetscInt n = std::ssize(sums.value);
  for (PetscInt i = 0; i < n; ++i) {
    const double part = point.weight * phi[i];
    sums.value[i] += part;
    sums.gap[i] += part * point.gap;
    sums.normal[i] = plus(sums.normal[i], point.normal, part);
    for (PetscInt j = 0; j < n; ++j) sums.products(j, i) += part * phi[j];
  }
  sums.covered += point.weight;
  sums.largestGap = std::max(sums.largestGap, std::abs(point.gap));
  sums.points.push_back(point.slave);
}

void addMaster(MasterMoments& to, const NodeValues& phi, const OverlapPoint& point,
               const Face& master, const Velocity& velocity) {
  const FaceShape shape = faceShape(faceType(master.type), point.master);
  NodeValues along{};
  if (velocity) {
    const FacePoint at = facePoint(master, shape);
    along = derivativeAlong(at, shape, velocity(to.face, at.position));
  }
  for (PetscInt l = 0; l < to.values.columns(); ++l)
    for (PetscInt i = 0; i < to.values.rows(); ++i) {
      const double part = point.weight * phi[i];
      to.values(i, l) += part * shape.value[l];
      if (velocity) to.convected(i, l) += part * along[l];
    }
}

}  // namespace

FaceMoments moments(const Face& slave, std::span<const Face* const> masters,
                    std::span<const OverlapPoint> points, const Velocity& velocity) {
  const FaceType& type = faceType(slave.type);
  const PetscInt n = type.nodes;
  FaceMoments sums;
  sums.type = slave.type;
  sums.value.resize(n), sums.gap.resize(n), sums.normal.resize(n);
  sums.products = DenseMatrix(n, n);
  sums.points.reserve(points.size());
  std::map<std::size_t, std::size_t> place;
  for (const auto& point : points) {
    const NodeValues phi = faceShape(type, point.slave).value;
    addSlave(sums, phi, point);
    const Face& master = *masters[point.masterFace];
    const auto [found, isNew] = place.try_emplace(point.masterFace, sums.masters.size());
    if (isNew) {
      const PetscInt m = master.points.size();
      sums.masters.push_back(
          {point.masterFace, DenseMatrix(n, m), velocity ? DenseMatrix(n, m) : DenseMatrix()});
    }
    addMaster(sums.masters[found->second], phi, point, master, velocity);
  }
  return sums;
}

}  // namespace squeal::mortar
