#include "peers/box.hpp"

#include "granum/math/constants.hpp"

#include <algorithm>
#include <vector>

namespace granum::peers
{
namespace
{
dem::Settings settings_of(Vec3 const& upper, Touching const& touching, Engine const& how)
{
    dem::Settings settings;
    settings.laws.normal = law::contact::HertzTsuji{touching.attraction};
    if (touching.rolling)
        settings.laws.rolling = law::contact::Epsd{};
    else
        settings.laws.rolling = law::contact::NoRolling{};
    settings.laws.lever = touching.lever;
    settings.laws.add({.youngs_modulus = 1e7, .poisson_ratio = 0.25});
    settings.laws.pair(0, 0,
                       {.restitution = touching.restitution,
                        .sliding_friction = touching.sliding_friction,
                        .rolling_friction = touching.rolling_friction});
    settings.lower = {0, 0, 0};
    settings.upper = upper;
    settings.gravity = {0, 0, -9.81};
    settings.skin = how.skin;
    settings.kernel = how.kernel;
    settings.energy_ledger = how.energy_ledger;
    auto const plane = [&settings](Vec3 const& point, Vec3 const& normal) {
        settings.walls.push_back({.name = "plane", .shapes = {geometry::Plane{point, normal}}});
    };
    plane({0, 0, 0}, {0, 0, 1});
    plane({0, 0, 0}, {1, 0, 0});
    plane({upper.x, 0, 0}, {-1, 0, 0});
    plane({0, 0, 0}, {0, 1, 0});
    plane({0, upper.y, 0}, {0, -1, 0});
    return settings;
}

// Calls act(id, sphere) for every sphere of the tiled state.
template <class Act>
void for_each_sphere(State const& state, long tiles_x, long tiles_y, Act const& act)
{
    std::uint64_t id = 0;
    for (long j = 0; j < tiles_y; ++j)
        for (long i = 0; i < tiles_x; ++i)
            for (auto const& sphere : state.spheres) act(++id, in_tile(state, sphere, i, j));
}

// As many granules for each rank as for the others: each looks at every so many-th of them.
par::Partition cut(State const& state, long tiles_x, long tiles_y, par::Space const& space,
                   par::Communicator const& comm)
{
    if (comm.size() == 1) return par::Partition(space);
    auto const ranks = static_cast<std::uint64_t>(comm.size()), rank = static_cast<std::uint64_t>(comm.rank());
    std::vector<Vec3> points;
    for_each_sphere(state, tiles_x, tiles_y, [&](std::uint64_t id, Sphere const& sphere) {
        if (id % ranks == rank) points.push_back(sphere.position);
    });
    return par::Partition::balanced(space, points, std::vector<double>(points.size(), 1.0), comm);
}
}

Box::Box(State const& state, long tiles_x, long tiles_y, Touching const& touching, Engine const& how,
         par::Communicator const& comm)
{
    double top = 0;
    for (auto const& sphere : state.spheres) top = std::max(top, sphere.position.z);
    Vec3 const upper{state.length_x * static_cast<double>(tiles_x), state.length_y * static_cast<double>(tiles_y),
                     std::max(0.2, 2 * top)};
    auto const partition = cut(state, tiles_x, tiles_y, {{{0, 0, 0}, upper}, {}}, comm);

    // Counted first, so that no column grows step by step and leaves its shorter self in the peak of memory.
    std::size_t mine = 0;
    for_each_sphere(state, tiles_x, tiles_y, [&](std::uint64_t, Sphere const& sphere) {
        mine += partition.owner(sphere.position) == comm.rank() ? 1 : 0;
    });
    granules.keep({.parcel = false, .gas = false, .process = false});
    granules.resize(mine);
    granules.owned = mine;
    std::size_t row = 0;
    for_each_sphere(state, tiles_x, tiles_y, [&](std::uint64_t id, Sphere const& sphere) {
        if (partition.owner(sphere.position) != comm.rank()) return;
        granules.id[row] = id;
        granules.position[row] = sphere.position;
        granules.velocity[row] = sphere.velocity;
        granules.spin[row] = sphere.spin;
        granules.radius[row] = sphere.radius;
        granules.mass[row] = 4.0 / 3.0 * math::pi * sphere.radius * sphere.radius * sphere.radius * state.density;
        ++row;
    });
    total = comm.sum(static_cast<long>(mine));

    auto settings = settings_of(upper, touching, how);
    settings.balance_every = 10;
    engine = std::make_unique<dem::Engine>(std::move(settings), partition, comm);
    engine->prepare(granules);
    if (comm.size() > 1) engine->rebalance(granules);  // by contacts, which were not known before
}

double Box::kinetic_energy(par::Communicator const& comm) const
{
    double sum = 0;
    for (std::size_t row = 0; row < granules.owned; ++row)
        sum += 0.5 * granules.mass[row] * norm2(granules.velocity[row]);
    return comm.sum(sum);
}

double Box::coordination(par::Communicator const& comm) const
{
    long pairs = 0;
    for (auto const& contact : engine->save_contacts())
        pairs += (contact.high & dem::ContactRecord::wall_bit) == 0 ? 1 : 0;
    return 2 * static_cast<double>(comm.sum(pairs)) / static_cast<double>(total);
}
}
