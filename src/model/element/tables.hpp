// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The tables that the program element_tables has generated for this build. Not collective.
#include <span>

#include "model/element/shape.hpp"

namespace squeal::element {

/// Returns the tables with rules of the degree 2·order + 1.
std::span<const ShapeTable> fullTables();
/// Returns the tables with rules of degree 2.
std::span<const ShapeTable> reducedTables();
/// Returns the tables with rules of degree 3 that leave hourglass modes.
std::span<const ShapeTable> underintegratedTables();

}  // namespace squeal::element
