// An apparatus of solids with bodies from STL files: its volume, what flows through it, and granules that stay in it.
// Every number comes from closed forms: volumes of cones and polyhedra, and what enters.
#include "granum/sim/case_reader.hpp"
#include "granum/sim/simulation.hpp"
#include "scene/closed_meshes.hpp"
#include "scene/stl_bytes.hpp"
#include "scene/temporary_folder.hpp"
#include "verify/table.hpp"

#include <array>
#include <fstream>

namespace
{
using namespace granum;
using scene::Triangles;

//! A draft tube of `sides` sides, its radii (mm) at the corners, from `low` to `high` (mm).
Triangles draft_tube(int sides, double inner, double outer, double low, double high)
{
    auto const at = [&](double radius, int k, double z) {
        double const angle = 2 * math::pi * (k % sides) / sides;
        return math::Vec3{radius * std::cos(angle), radius * std::sin(angle), z};
    };
    Triangles out;
    auto const quad = [&](math::Vec3 const& a, math::Vec3 const& b, math::Vec3 const& c, math::Vec3 const& d) {
        out.push_back({a, b, c}), out.push_back({a, c, d});
    };
    for (int k = 0; k < sides; ++k) {
        quad(at(outer, k, low), at(outer, k + 1, low), at(outer, k + 1, high), at(outer, k, high));
        quad(at(inner, k + 1, low), at(inner, k, low), at(inner, k, high), at(inner, k + 1, high));
        quad(at(inner, k, low), at(inner, k + 1, low), at(outer, k + 1, low), at(outer, k, low));
        quad(at(outer, k, high), at(outer, k + 1, high), at(inner, k + 1, high), at(inner, k, high));
    }
    return out;
}

//! A block of 30 x 20 x 16 mm, turned by (36.87, 0, 22.62) degrees, its middle at (70, 0, 150) mm.
Triangles block()
{
    auto triangles = scene::box_surface({-15, -10, -8}, {15, 10, 8});
    for (auto& triangle : triangles)
        for (auto& x : triangle) {
            math::Vec3 const tilted{x.x, 0.8 * x.y - 0.6 * x.z, 0.6 * x.y + 0.8 * x.z};
            x = math::Vec3{70, 0, 150} +
                math::Vec3{12 * tilted.x - 5 * tilted.y, 5 * tilted.x + 12 * tilted.y, 13 * tilted.z} / 13;
        }
    return triangles;
}

constexpr int sides = 12;
constexpr double inner = 30, outer = 34, tube_low = 40, tube_high = 180;  // mm
double const around = 0.5 * sides * std::sin(2 * math::pi / sides);       // area of the polygon over radius squared
double const bodies_volume = 1e-9 * (around * (outer * outer - inner * inner) * (tube_high - tube_low) + 30 * 20 * 16);
//! A cone from 100 to 220 mm over 200 mm, and a column of 120 mm on it.
double const volume =
    math::pi * (0.2 / 3 * (0.05 * 0.05 + 0.05 * 0.11 + 0.11 * 0.11) + 0.12 * 0.11 * 0.11) - bodies_volume;

std::string const apparatus = R"(
[apparatus]
shape = "solids"
[[apparatus.solid]]
name = "cone"
shape = "cone"
base = ["0 mm", "0 mm", "0 mm"]
length = "200 mm"
base_diameter = "100 mm"
top_diameter = "220 mm"
[[apparatus.solid]]
name = "column"
shape = "cylinder"
base = ["0 mm", "0 mm", "200 mm"]
length = "120 mm"
diameter = "220 mm"
[[internal]]
name = "tube"
shape = "stl"
file = "tube.stl"
unit = "mm"
[[internal]]
name = "block"
shape = "stl"
file = "block.stl"
unit = "mm"
)";

//! `above` stands before all sections.
sim::Case resolved(std::string const& rest, std::string const& above = "")
{
    scene::TemporaryFolder const folder;
    std::ofstream(folder / "case.toml") << above + apparatus + rest;
    std::ofstream(folder / "tube.stl", std::ios::binary)
        << scene::binary_stl(draft_tube(sides, inner, outer, tube_low, tube_high));
    std::ofstream(folder / "block.stl", std::ios::binary) << scene::binary_stl(block());
    return sim::read_case(folder / "case.toml").data;
}

//! Air of constant density, Reynolds number 60 at the plate.
std::string const flow = R"(
[gas]
dry_mass_flow = "1.0 kg/h"
humidity = "0 g/kg"
temperature = "20 degC"
density = "1.2 kg/m3"
viscosity = "6e-5 Pa s"
cells = [22, 22, 32]
tolerance = 1e-12
[start]
quasi_steady = false
[time]
duration = "1 s"
)";

//! Largest difference of what passes a horizontal plane of faces from what enters, over what enters.
double off_by_plane(sim::Simulation const& simulation, par::Communicator const& comm)
{
    auto const& grid = simulation.grid();
    std::vector<double> through(static_cast<std::size_t>(grid.global[2]), 0.0);
    grid::for_each_cell(grid, [&](int, int, int k, grid::Index c) {
        through[static_cast<std::size_t>(k + grid.shift[2])] += simulation.gas().mass_flux[2][c];
    });
    comm.sum(std::span(through));
    double const enters = simulation.solver().settings().inlets.front().mass_flow;
    double worst = 0;
    for (double const one : through) worst = std::max(worst, std::abs(one / enters - 1));
    return worst;
}

TEST(ApparatusOfSolids, lets_through_every_plane_what_enters)
{
    auto const data = resolved(flow);
    for (MPI_Comm const ranks : {MPI_COMM_SELF, MPI_COMM_WORLD}) {
        par::Communicator const comm(ranks);
        sim::Simulation simulation(data, comm);
        auto const on = fmt::format("on {} rank{}", comm.size(), comm.size() > 1 ? "s" : "");
        double open = 0, worst = 0;
        grid::for_each_cell(simulation.grid(),
                            [&](int, int, int, grid::Index c) { open += simulation.grid().open_volume[c]; });
        verify::relative("S01", "cone, column and STL bodies " + on + ": open volume of the cells, m3", volume,
                         comm.sum(open), 1e-4);
        for (int step = 0; step < 200; ++step) {
            simulation.step(0.02);
            if (step % 20 == 19) worst = std::max(worst, off_by_plane(simulation, comm));
        }
        verify::below("S01", "the same, laminar: flow through every plane of faces against the inlet, share off " + on,
                      1e-8, worst);
        EXPECT_LT(std::abs(simulation.gas().velocity[2][simulation.grid().at(0, 0, 0)]), 10);
    }
}

TEST(ApparatusOfSolids, keeps_granules_that_bounce_about_in_it)
{
    auto const data = resolved(R"(
[granules]
diameter = "5 mm"
density = "1500 kg/m3"
number = 600
start = "loose"
agitation = "1.5 m/s"
[contact]
youngs_modulus = "5 MPa"
restitution = 0.98
sliding_friction = 0.1
[time]
duration = "1 s"
)",
                               "gravity = [\"0 m/s2\", \"0 m/s2\", \"0 m/s2\"]\n");
    for (MPI_Comm const ranks : {MPI_COMM_SELF, MPI_COMM_WORLD}) {
        par::Communicator const comm(ranks);
        sim::Simulation simulation(data, comm);
        long outside = 0, fewest = 600;
        while (simulation.time() < 0.4) {
            simulation.step(0.001);
            auto const& granules = simulation.granules();
            for (std::size_t row = 0; row < granules.owned; ++row)
                outside += !data.chamber.inside(granules.position[row]);
            fewest = std::min(fewest, comm.sum(static_cast<long>(granules.owned)));
        }
        auto const what = fmt::format("600 granules about the bodies for 0.4 s on {} rank{}", comm.size(),
                                      comm.size() > 1 ? "s" : "");
        verify::absolute("S01", what + ": fewest of them", 600, static_cast<double>(fewest), 0);
        verify::absolute("S01", what + ": centres seen in a wall", 0, static_cast<double>(comm.sum(outside)), 0);
    }
}
}
