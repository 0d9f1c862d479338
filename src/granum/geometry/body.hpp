// Wall bodies: named walls of one material with one motion, made of one or several shapes.
#pragma once

#include "granum/geometry/bounds.hpp"
#include "granum/geometry/motion.hpp"
#include "granum/geometry/shape.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace granum::geometry
{
//! A wall as a case states it. Contacts of a granule with one body are sorted out among its shapes; those with two
//! bodies are independent.
struct Body
{
    std::string name;
    std::vector<Shape> shapes;
    std::uint32_t material = 0;     //!< index in the table of materials
    std::vector<Motion> motions{};  //!< in the order in which they act (see pose()); at most one servo
    Vec3 origin{};                  //!< about which torques are reported, m; moves with the body
};

//! Whether the rotation leaves the shape where it is (a shape of revolution about the same axis).
bool unmoved(Shape const& shape, Rotation const& rotation);

//! How many of the first motions are rotations that leave every shape of the body where it is.
std::size_t rotations_in_place(Body const& body);

//! Area that discs, spheres and meshes turn to `direction` (unit), m2: of each mesh the larger of the parts that face
//! along and against it. Nothing for a body with a plane or a flank, whose area must be given.
std::optional<double> facing_area(Body const& body, Vec3 const& direction);

//! The box around the body as drawn; infinite where it has a plane.
Bounds bounds(Body const& body);
}
