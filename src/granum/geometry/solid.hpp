// Solids: closed bodies that tell how far any point is from their surface, and on which side of it.
#pragma once

#include "granum/geometry/bounds.hpp"
#include "granum/geometry/chamber.hpp"
#include "granum/geometry/revolution.hpp"

#include <memory>
#include <optional>
#include <string>
#include <variant>

namespace granum::geometry
{
class ClosedMesh;

//! Axis-aligned.
struct Box
{
    Vec3 lower, upper;  //!< m
};

struct Ball
{
    Vec3 centre;        //!< m
    double radius = 0;  //!< m
};

//! All that is behind a plane. Without bounds: good for cutting others.
struct HalfSpace
{
    Vec3 point;            //!< of the plane, m
    Vec3 normal{0, 0, 1};  //!< unit, out of the solid
};

using Solid = std::variant<Box, Ball, HalfSpace, Revolution, std::shared_ptr<ClosedMesh const>>;

//! Exact for every solid. Where the surface is farther than `enough` (m), a lower distance above that and any normal
//! may be given, if that is faster.
SurfaceDistance surface_distance(Solid const& solid, Vec3 const& x,
                                 double enough = std::numeric_limits<double>::infinity());
Bounds bounds(Solid const& solid);

//! What makes this no solid, to be read after its name; nothing for a good one.
std::optional<std::string> fault(Solid const& solid);

//! The inside of a chamber, plate and outlet included.
Solid solid(Chamber const& chamber);
}
