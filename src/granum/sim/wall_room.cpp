#include "granum/sim/wall_room.hpp"

namespace granum::sim
{
WallRoom::WallRoom(Case const& data) : chamber_(data.chamber), outline_(data.chamber)
{
    outline_.region.reset(), outline_.levels.reset();
    for (auto const& body : data.bodies) bodies_.emplace_back(body);
    for (auto const& body : data.walls) bodies_.emplace_back(body);
}

bool WallRoom::operator()(Vec3 const& centre, double radius)
{
    if (!chamber_.inside(centre)) return false;
    if (outline_.known() && !outline_.inside(centre, radius)) return false;
    for (auto const& body : bodies_) {
        facets_.clear();
        body.near(centre, radius, facets_);
        std::array<geometry::Nearest, geometry::most_touches> touches;
        if (body.touches(centre, radius, facets_, scratch_, touches) > 0) return false;
    }
    return true;
}
}
