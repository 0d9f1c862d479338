#include "granum/gas/inside.hpp"

#include "granum/base/error.hpp"
#include "granum/material/moist_air.hpp"

#include <cmath>

namespace granum::gas
{
Rows::Rows(grid::Grid const& grid) : inverse(grid.make_field()), right(grid.make_field()), partial(grid.make_field())
{
    for (auto& field : coupling) field = grid.make_field();
}

Solver::Inside::Inside(Settings given, grid::Grid const& cells_of_rank, par::Communicator const& ranks)
    : settings(std::move(given)),
      grid(cells_of_rank),
      comm(ranks),
      area(grid.open_area),
      face_volume(grid.make_face_field(1)),
      solved(grid.make_face_field()),
      bounding(grid.make_face_field()),
      per_gap(grid.make_face_field()),
      low_share(grid.make_face_field()),
      coupled{grid.make_face_field(), grid.make_face_field(), grid.make_face_field()},
      reach{grid.make_face_field(), grid.make_face_field(), grid.make_face_field()},
      weights{},
      pressure(grid, ranks, settings.pressure_solver),
      system(grid),
      correction(grid.make_field()),
      exchanged(grid.make_field(settings.expansion_temperature)),
      mobility(grid.make_face_field(1)),
      stress(grid.make_face_field()),
      inertia(grid.make_field()),
      gas_volume(grid.make_field()),
      expected_temperature(grid.make_field(settings.expansion_temperature)),
      expected_vapour(grid.make_field()),
      expected_tracer(grid.make_field()),
      viscous(grid.make_field()),
      middle_flux(grid.make_face_field()),
      friction(grid.make_face_field()),
      dragged(grid.make_face_field()),
      begun(grid.make_face_field()),
      rows(grid),
      halves(grid),
      change(grid.make_field()),
      half(grid.make_field(0.5)),
      link_flux(grid.make_face_field()),
      limit(grid),
      carried{.content = grid.make_field(),
              .capacity = grid.make_field(),
              .flux = grid.make_face_field(),
              .conductance = grid.make_face_field(),
              .source = grid.make_field(),
              .sink = grid.make_field(),
              .at_inlets = {},
              .at_outlets = {},
              .passed = grid.make_face_field()}
{
    if (settings.density) settings.compressibility = Compressibility::constant;
    base::require(settings.compressibility != Compressibility::constant || settings.density.has_value(),
                  "gas: a constant density is asked for, but none is given");
    base::require(!settings.walls.empty(), "gas: no wall is described");
    find_openings();
    find_faces();
    bounding = solved;
    for (auto const& face : inlets) bounding[face.d][face.face] = 1;
    find_walls();
    make_closure();
}

double Solver::Inside::viscosity(double temperature) const
{
    return settings.viscosity ? *settings.viscosity : material::viscosity(temperature);
}

double Solver::Inside::equation_of_state(double at_pressure, double temperature, double vapour, double tracer) const
{
    if (settings.density) return *settings.density;
    double const carrier = settings.molar_mass.value_or(material::molar_mass_air);
    double const water = settings.vapour_molar_mass.value_or(material::molar_mass_water);
    double const rest = settings.tracer ? settings.tracer->molar_mass.value_or(carrier) : carrier;
    double const moles = (1 - vapour - tracer) / carrier + vapour / water + tracer / rest;
    return at_pressure / (math::gas_constant * temperature * moles);
}

void Solver::Inside::check(Sources const& sources) const
{
    // What is given to a closed cell would be lost without a word.
    grid::for_each_cell(grid, [&](int i, int j, int k, Index c) {
        if (grid.open(c)) return;
        bool const none = sources.mass[c] == 0 && sources.vapour[c] == 0 && sources.enthalpy[c] == 0 &&
                          sources.heat_value[c] == 0 && sources.heat_coefficient[c] == 0;
        base::require(none, "gas: a source lies in cell ({}, {}, {}), which is closed by the wall", i + grid.shift[0],
                      j + grid.shift[1], k + grid.shift[2]);
    });
}

SharedSources Solver::Inside::share(Sources const& sources) const
{
    SharedSources shared{sources.drag_coefficient, sources.mass, sources.drag_momentum, sources.force};
    for (std::size_t d = 0; d < 3; ++d)
        if (settings.push[d] != 0)
            for (Index c = 0; c < gas_volume.size(); ++c)
                shared.drag_momentum[d][c] += settings.push[d] * gas_volume[c];
    add_couples(sources.couple, shared.force);
    refresh({&shared.drag_coefficient, &shared.mass, &shared.drag_momentum[0], &shared.drag_momentum[1],
             &shared.drag_momentum[2], &shared.force[0], &shared.force[1], &shared.force[2]});
    return shared;
}

void Solver::Inside::check(State const& state) const
{
    auto look = [&](Field const& field, char const* name, bool positive) {
        bool good = true;
        for (auto const& run : cells)
            for (Index c = run.first; c < run.end; ++c)
                good = good && std::isfinite(field[c]) && (!positive || field[c] > 0);
        if (good) return;
        grid::for_each_cell(grid, [&](int i, int j, int k, Index c) {
            if (!grid.open(c) || (std::isfinite(field[c]) && !(positive && !(field[c] > 0)))) return;
            Vec3 const x = grid.centre(i, j, k);
            throw base::NumericsError(fmt::format("gas: {} is {} in cell ({}, {}, {}) at ({:.4g}, {:.4g}, {:.4g}) m",
                                                  name, field[c], i + grid.shift[0], j + grid.shift[1],
                                                  k + grid.shift[2], x.x, x.y, x.z));
        });
    };
    look(state.mass, "mass", true);
    look(state.pressure, "pressure", false);
    look(state.velocity[0], "velocity along x", false);
    look(state.velocity[1], "velocity along y", false);
    look(state.velocity[2], "velocity along z", false);
    look(state.vapour_fraction, "vapour fraction", false);
    look(state.tracer_fraction, "tracer fraction", false);
    look(state.temperature, "temperature", true);
}
}
