// Small scenes of granules: built in one line, run through the engine, shared by tests and benchmarks.
#pragma once

#include "granum/dem/engine.hpp"
#include "granum/math/constants.hpp"
#include "granum/particle/generate.hpp"

#include <vector>

namespace granum::scene
{
using math::Vec3;

//! What a sphere is made of and how it touches.
struct Stuff
{
    double youngs_modulus, poisson_ratio, density;
};
inline constexpr Stuff glass{4.8e10, 0.20, 2800}, limestone{2.0e10, 0.25, 2500}, aluminium_alloy{7.0e10, 0.30, 2699},
    magnesium_alloy{4.0e10, 0.35, 1800}, aluminium_oxide{3.8e11, 0.23, 4000}, aluminium_alloy_oblique{7e10, 0.33, 2700},
    nylon{2.5e9, 0.40, 1000}, copper{1.2e11, 0.35, 8900}, steel{2.08e11, 0.30, 7850}, polyethylene{1e9, 0.40, 1400};

//! Granules, the engine's settings and what steps them: one rank unless slabs and a communicator are given.
struct Scene
{
    particle::Store granules;
    dem::Settings settings;
    par::Slabs slabs;
    par::Communicator comm{MPI_COMM_SELF};
    std::unique_ptr<dem::Engine> engine;

    //! A scene in open space with one material for granules (0) and a rigid one for walls (1), without gravity.
    explicit Scene(Stuff const& stuff, dem::PairProperties const& properties = {})
    {
        settings.gravity = {};
        settings.lower = {-100, -100, -100};
        settings.upper = {100, 100, 100};
        settings.laws.add({stuff.youngs_modulus, stuff.poisson_ratio, false});
        settings.laws.add({1, 0, true});
        for (std::uint32_t wall : {0u, 1u}) settings.laws.pair(0, wall, properties);
        slabs.origin = -100;
        slabs.width = 200;
    }

    std::size_t add(Vec3 const& position, Vec3 const& velocity, double radius, double density, Vec3 const& spin = {},
                    std::uint32_t material = 0)
    {
        std::size_t const row = granules.rows();
        granules.resize(row + 1);
        granules.owned = row + 1;
        granules.id[row] = row;
        granules.position[row] = position;
        granules.velocity[row] = velocity;
        granules.spin[row] = spin;
        granules.radius[row] = radius;
        granules.diameter[row] = 2 * radius;
        granules.mass[row] = 4.0 / 3.0 * math::pi * radius * radius * radius * density;
        granules.material[row] = material;
        granules.count[row] = 1;
        return row;
    }

    void add_plane(Vec3 const& point, Vec3 const& normal)
    {
        settings.walls.push_back({.name = "plane", .shapes = {geometry::Plane{point, normal}}, .material = 1});
    }

    //! A box open to nothing: six planes, and the domain to match.
    void enclose(Vec3 const& lower, Vec3 const& upper)
    {
        settings.lower = lower;
        settings.upper = upper;
        slabs.origin = lower.x;
        slabs.width = upper.x - lower.x;
        for (std::size_t d = 0; d < 3; ++d) {
            Vec3 normal;
            normal[d] = 1;
            add_plane(lower, normal);
            add_plane(upper, -normal);
        }
    }

    void prepare()
    {
        engine = std::make_unique<dem::Engine>(settings, slabs, comm);
        engine->prepare(granules);
    }

    void run(long steps, double dt) { engine->advance(granules, dt, static_cast<int>(steps)); }

    //! Row of the granule with this id; owned rows only.
    std::size_t row(particle::Id id) const
    {
        std::size_t at = 0;
        while (granules.id[at] != id) ++at;
        return at;
    }

    double kinetic_energy() const
    {
        double sum = 0;
        for (std::size_t k = 0; k < granules.owned; ++k)
            sum += 0.5 * granules.mass[k] * norm2(granules.velocity[k]) +
                   0.2 * granules.mass[k] * granules.radius[k] * granules.radius[k] * norm2(granules.spin[k]);
        return sum;
    }

    double potential_energy() const
    {
        double sum = 0;
        for (std::size_t k = 0; k < granules.owned; ++k)
            sum -= granules.mass[k] * dot(settings.gravity, granules.position[k]);
        return sum;
    }

    Vec3 momentum() const
    {
        Vec3 sum;
        for (std::size_t k = 0; k < granules.owned; ++k) sum += granules.mass[k] * granules.velocity[k];
        return sum;
    }
};

//! Duration of an elastic Hertz contact, s (Johnson 1985): effective modulus, radius, mass and closing speed.
inline double hertz_time(double modulus, double radius, double mass, double speed)
{
    return 2.943275 * std::pow(15 * mass * speed * speed / (16 * modulus * std::sqrt(radius)), 0.4) / speed;
}

//! Course of one impact, from touch to release.
struct Impact
{
    double largest_force = 0, largest_overlap = 0;  // N, m
    double duration = 0;                            // s
    long steps = 0;
};

//! Steps until the only contact of the scene has begun and ended; the time of contact is counted in whole steps and
//! refined by the overlap of the first step and that of the last at the speeds then.
inline Impact run_impact(Scene& scene, double dt, long most = 10'000'000)
{
    Impact seen;
    bool touched = false;
    for (; seen.steps < most; ++seen.steps) {
        scene.engine->step(scene.granules, dt);
        auto const contacts = scene.engine->contacts();
        if (contacts.empty()) {
            if (touched) break;
            continue;
        }
        touched = true;
        seen.duration += dt;
        seen.largest_force = std::max(seen.largest_force, contacts[0].normal_force);
        seen.largest_overlap = std::max(seen.largest_overlap, contacts[0].overlap);
    }
    return seen;
}

//! Two equal spheres that meet head on along x, each with `speed`, gap one step away.
inline Scene two_spheres(Stuff const& stuff, double radius, double speed, dem::PairProperties const& properties,
                         Vec3 const& spin = {})
{
    Scene scene(stuff, properties);
    double const apart = radius * (1 + 1e-9);
    scene.add({-apart, 0, 0}, {speed, 0, 0}, radius, stuff.density, spin);
    scene.add({apart, 0, 0}, {-speed, 0, 0}, radius, stuff.density, spin);
    return scene;
}

//! A sphere just above the rigid plane z = 0 with the given velocity and spin.
inline Scene sphere_on_plane(Stuff const& stuff, double radius, Vec3 const& velocity,
                             dem::PairProperties const& properties, Vec3 const& spin = {})
{
    Scene scene(stuff, properties);
    scene.add_plane({0, 0, 0}, {0, 0, 1});
    scene.add({0, 0, radius * (1 + 1e-9)}, velocity, radius, stuff.density, spin);
    return scene;
}
}
