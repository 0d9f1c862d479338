// Beds of equal spheres on the granule engine, and what is measured on them.
#pragma once

#include "granum/base/random.hpp"
#include "granum/particle/rows.hpp"
#include "page.hpp"
#include "scene/granules.hpp"

#include <functional>
#include <numeric>

namespace granum::validate
{
using math::Vec3;
using scene::Scene;

//! The picture of a bed in its outline (corners x, z), cut at y = `mid_plane`.
inline io::Snapshot snapshot_of(Scene const& scene, std::vector<std::array<double, 2>> const& outline, double mid_plane)
{
    io::Snapshot out;
    out.mid_plane = mid_plane;
    out.outline = outline;
    for (std::size_t row = 0; row < scene.granules.owned; ++row) {
        out.granules.position.push_back(scene.granules.position[row]);
        out.granules.radius.push_back(scene.granules.radius[row]);
    }
    return out;
}

//! Speeds of the granules, m/s.
inline std::vector<double> speeds(Scene const& scene)
{
    std::vector<double> out;
    for (std::size_t row = 0; row < scene.granules.owned; ++row) out.push_back(norm(scene.granules.velocity[row]));
    return out;
}

//! Takes out the granules for which `gone` holds; contacts of the others go on. Returns how many went.
inline long remove(Scene& scene, std::function<bool(Vec3 const&)> const& gone)
{
    std::vector<std::uint32_t> stay;
    auto& granules = scene.granules;
    for (std::uint32_t row = 0; row < granules.owned; ++row)
        if (!gone(granules.position[row])) stay.push_back(row);
    long const left = static_cast<long>(granules.owned - stay.size());
    if (left > 0) {
        reorder(granules, stay);
        scene.engine->prepare(granules);
    }
    return left;
}

//! Runs until the kinetic energy per granule is below that of a fall by 1e-4 of a radius, at least `least` and at most
//! `most` steps.
inline void settle(Scene& scene, double dt, long least, long most)
{
    scene.run(least, dt);
    double const radius = scene.granules.radius[0], mass = scene.granules.mass[0];
    for (long done = least; done < most; done += 500) {
        double const still = 1e-4 * radius * mass * norm(scene.settings.gravity);
        if (scene.kinetic_energy() < still * static_cast<double>(scene.granules.owned)) return;
        scene.run(500, dt);
    }
}

//! Share of the slab z0 < z < z1 over `area` that spheres fill: each counts with the part of it inside.
inline double solids_between(Scene const& scene, double z0, double z1, double area)
{
    double sum = 0;
    for (std::size_t row = 0; row < scene.granules.owned; ++row) {
        double const radius = scene.granules.radius[row], z = scene.granules.position[row].z;
        // Volume of the sphere below the height h above its lowest point.
        auto const below = [radius](double h) {
            double const x = std::clamp(h, 0.0, 2 * radius);
            return math::pi * x * x * (radius - x / 3);
        };
        sum += below(z1 - z + radius) - below(z0 - z + radius);
    }
    return sum / (area * (z1 - z0));
}

inline double mean(std::vector<double> const& x)
{
    return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

//! Slope of y against x by least squares.
inline double slope(std::vector<double> const& x, std::vector<double> const& y)
{
    double const mean_x = mean(x), mean_y = mean(y);
    double xx = 0, xy = 0;
    for (std::size_t k = 0; k < x.size(); ++k)
        xx += (x[k] - mean_x) * (x[k] - mean_x), xy += (x[k] - mean_x) * (y[k] - mean_y);
    return xy / xx;
}
}
