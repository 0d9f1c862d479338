// A horizontal drum that begins to turn when its filling has come to rest: shared by the test of its bits on several
// ranks and that of its surface.
#pragma once

#include "granum/base/random.hpp"
#include "scene/granules.hpp"

namespace granum::scene
{
//! About the y axis, periodic along it.
struct Drum
{
    double radius, length;  //!< m
    double rate;            //!< rad/s
    double start;           //!< time at which it begins to turn, s
};

//! The drum with spheres of `radius` (m) that hang in rows, agitated a little, and will fill the share `fill` of it.
inline Scene filled_drum(Drum const& drum, Stuff const& stuff, dem::PairProperties const& properties, double radius,
                         double fill)
{
    Scene scene(stuff, properties);
    scene.settings.gravity = {0, 0, -9.81};
    scene.settings.lower = {-drum.radius, 0, -drum.radius};
    scene.settings.upper = {drum.radius, drum.length, drum.radius};
    scene.settings.periodic = {false, true, false};
    scene.slabs.origin = -drum.radius;
    scene.slabs.width = 2 * drum.radius;
    Vec3 const axis{0, 1, 0};
    scene.settings.walls.push_back({.name = "drum",
                                    .shapes = {geometry::Frustum{.base = {0, -drum.length, 0},
                                                                 .axis = axis,
                                                                 .length = 3 * drum.length,
                                                                 .base_radius = drum.radius,
                                                                 .top_radius = drum.radius,
                                                                 .side = geometry::Side::inside}},
                                    .material = 1,
                                    .motions = {geometry::Rotation{{}, axis, drum.rate, {drum.start}}}});
    double const spacing = 2.15 * radius, area = math::pi * drum.radius * drum.radius;
    double const wanted = 0.58 * fill * area * drum.length / (4.0 / 3.0 * math::pi * radius * radius * radius);
    int const along = static_cast<int>(drum.length / spacing);
    double const step = drum.length / along;
    for (double z = -drum.radius + radius; static_cast<double>(scene.granules.rows()) < wanted; z += spacing)
        for (double x = -drum.radius + radius; x < drum.radius; x += spacing) {
            if (std::hypot(x, z) > drum.radius - 1.05 * radius) continue;
            for (int k = 0; k < along; ++k) {
                base::Random random(4, base::Purpose::test, scene.granules.rows(), 0);
                Vec3 const velocity{random.normal(), random.normal(), random.normal()};
                scene.add({x, (k + 0.5) * step, z}, 0.3 * std::sqrt(9.81 * radius) * velocity, radius, stuff.density);
            }
        }
    return scene;
}
}
