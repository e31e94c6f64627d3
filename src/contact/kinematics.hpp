#pragma once
/// This function builds the kinematics u = A z of contact, with a normal and tangents at each
/// contact node.
#include <vector>

#include "contact/contact.hpp"

namespace squeal::contact {

/// Collective. Fills A as it is before periodicity, assembles it, marks the free components of z in
/// Contact::free and sets the values of the others in `held`. `obstacleDisplacement` is that of the
/// rigid obstacle, m, [interface]. Throws Error on all ranks for a held component that is not
/// tangential at a contact node.
void buildKinematics(const std::vector<Point>& obstacleDisplacement, Contact& contact, Mat a,
                     Vec held);

}  // namespace squeal::contact
