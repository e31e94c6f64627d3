#pragma once
/// Matrices of sliding, and the small algebra that building the contact matrices needs.
#include "contact/contact.hpp"
#include "elasticity/elasticity.hpp"
#include "mesh/mesh.hpp"

namespace squeal::contact {

inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Point scaled(const Point& a, double s) { return {s * a[0], s * a[1], s * a[2]}; }

/// Collective. An N×N matrix with room for some dimension×dimension blocks in each row.
OwnedMat nodalMatrix(const mesh::Mesh& mesh, PetscInt blocksPerRow);
/// Collective. Ends the setting of values.
void assembled(Mat matrix);
/// Sets the block (global nodes). Explicit zeros are kept, so that friction only scales entries of
/// the frictionless pattern.
void setBlock(Mat matrix, int dimension, PetscInt rowNode, PetscInt columnNode,
              const std::vector<double>& block);
/// factor · a bᵀ, row-major.
std::vector<double> outer(const Point& a, const Point& b, int dimension, double factor = 1);

/// Collective. Fills reaction, jump and, with convective terms, convected.
void buildSliding(const elasticity::Bodies& bodies, Contact& contact);

}  // namespace squeal::contact
