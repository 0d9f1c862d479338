// Small scenes of hard spheres: built in one line, run through their engine, shared by tests and benchmarks.
#pragma once

#include "granum/base/random.hpp"
#include "granum/dem/hard_spheres.hpp"
#include "scene/granules.hpp"

namespace granum::scene
{
//! Granules, settings and the hard-sphere engine; material 0 is that of granules, 1 that of walls.
struct HardScene : Scene
{
    dem::HardOptions options;
    std::unique_ptr<dem::HardSpheres> hard;

    explicit HardScene(dem::PairProperties const& properties, double tangential_restitution = 0.33)
        : Scene(glass, properties), options{.tangential_restitution = tangential_restitution}
    {
    }

    void prepare_hard()
    {
        hard = std::make_unique<dem::HardSpheres>(settings, options);
        hard->prepare(granules);
    }
    void run_hard(double time, long steps = 1)
    {
        for (long k = 0; k < steps; ++k) hard->step(granules, time / static_cast<double>(steps));
    }
    dem::HardWatch& watch() { return hard->watch(); }

    //! Mean square of one velocity component about the mean velocity, m2/s2.
    double granular_temperature() const
    {
        Vec3 mean;
        for (std::size_t k = 0; k < granules.owned; ++k) mean += granules.velocity[k];
        mean = mean / static_cast<double>(granules.owned);
        double sum = 0;
        for (std::size_t k = 0; k < granules.owned; ++k) sum += norm2(granules.velocity[k] - mean);
        return sum / (3 * static_cast<double>(granules.owned));
    }

    //! How deep any two lie in each other, over the smaller radius, by looking at every pair.
    double deepest_overlap() const
    {
        double deepest = 0;
        for (std::size_t i = 0; i < granules.owned; ++i)
            for (std::size_t j = 0; j < i; ++j) {
                Vec3 apart = granules.position[i] - granules.position[j];
                for (std::size_t d = 0; d < 3; ++d) {
                    double const width = settings.upper[d] - settings.lower[d];
                    if (settings.periodic[d]) apart[d] -= width * std::round(apart[d] / width);
                }
                double const overlap = granules.radius[i] + granules.radius[j] - norm(apart);
                deepest = std::max(deepest, overlap / std::min(granules.radius[i], granules.radius[j]));
            }
        return deepest;
    }
};

//! A gas of `side`^3 spheres of 1 mm and 1000 kg/m3 in a periodic cube at `fraction` solids, with velocities from a
//! Maxwell distribution of the given granular temperature (m2/s2) and no mean.
inline HardScene hard_gas(int side, double fraction, double temperature, dem::PairProperties const& properties,
                          std::uint32_t seed = 1, double tangential_restitution = 0.33)
{
    HardScene scene(properties, tangential_restitution);
    double const d = 1e-3, spacing = d * std::cbrt(math::pi / 6 / fraction);
    scene.settings.lower = {};
    scene.settings.upper = Vec3{1, 1, 1} * (side * spacing);
    scene.settings.periodic = {true, true, true};
    std::size_t const count = static_cast<std::size_t>(side) * side * side;
    Vec3 mean;
    std::vector<Vec3> velocity(count);
    for (std::size_t k = 0; k < count; ++k) {
        base::Random random(seed, base::Purpose::test, k, 0);
        velocity[k] = Vec3{random.normal(), random.normal(), random.normal()};
        mean += velocity[k] * (1.0 / static_cast<double>(count));
    }
    double sum = 0;
    for (auto& v : velocity) v -= mean, sum += norm2(v);
    double const scale = std::sqrt(temperature * 3 * static_cast<double>(count) / sum);
    for (std::size_t k = 0; k < count; ++k) {
        auto const s = static_cast<std::size_t>(side);
        Vec3 const at{static_cast<double>(k % s), static_cast<double>(k / s % s), static_cast<double>(k / s / s)};
        scene.add((at + Vec3{0.5, 0.5, 0.5}) * spacing, scale * velocity[k], 0.5 * d, 1000);
    }
    return scene;
}
}
