#pragma once
/// Matrices of sliding, and the vector algebra for building the contact matrices.
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

/// Collective. Returns an N×N matrix with room for `blocksPerRow` dimension×dimension blocks per
/// row of blocks.
OwnedMat nodalMatrix(const mesh::Mesh& mesh, PetscInt blocksPerRow);
/// Collective. Assembles the matrix after values have been set.
void assembled(Mat matrix);
/// Sets the block of two global nodes. Zeros are kept as entries, so that friction only changes
/// values within the frictionless pattern.
void setBlock(Mat matrix, int dimension, PetscInt rowNode, PetscInt columnNode,
              const std::vector<double>& block);
/// Returns factor · a bᵀ, dimension × dimension, row-major.
std::vector<double> outer(const Point& a, const Point& b, int dimension, double factor = 1);

/// Collective. Fills Contact::reaction, Contact::jump and, with convective terms,
/// Contact::convected.
void buildSliding(const elasticity::Bodies& bodies, Contact& contact);

}  // namespace squeal::contact
