// From the velocity to the stress: eddy viscosity of the cells, viscosity under shear, what walls hold the gas with.
//
// All of it is taken at the beginning of a step and held. Walls: with a two-equation model u_tau comes from k (Launder
// and Spalding), with the others from the speed in the cell beside the wall; between wall and cell the two-layer law
// gives the viscosity with which the cell feels the wall (law/turbulence/wall.hpp).
#include "granum/gas/inside.hpp"

#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>

namespace granum::gas
{
namespace turbulence = law::turbulence;

namespace
{
constexpr double largest_ratio = 1e5;  // of eddy viscosity to viscosity

//! Share of the eddy viscosity that granules leave, 0 among dense ones.
double left_by_granules(Turbulence const& set, double voidage)
{
    double const s = std::clamp((voidage - set.dense) / (set.free - set.dense), 0.0, 1.0);
    return s * s * (3 - 2 * s);
}
}

void Solver::Inside::make_closure()
{
    bool const newtonian = std::holds_alternative<law::viscosity::Newtonian>(settings.thinning.law);
    auto const& model = settings.turbulence.model;
    if (newtonian && turbulence::is_laminar(model)) return;
    closure = std::make_unique<Closure>();
    Closure& it = *closure;
    it.molecular = it.eddy = it.width = grid.make_field();
    grid::for_each_cell(grid, [&](int, int, int, Index c) { it.width[c] = std::cbrt(grid.open_volume[c]); });
    it.wall_viscosity.assign(wall_pieces.size(), 0.0);
    it.wall_heat.assign(wall_pieces.size(), 1.0);
    if (!turbulence::transports(model)) return;
    for (Field* field :
         {&it.made, &it.lost, &it.rate_made, &it.rate_lost, &it.granular, &it.spread_energy, &it.spread_rate})
        *field = grid.make_field();
    it.fixed_rate = grid.make_field(-1);
    if (std::holds_alternative<turbulence::KOmegaSst>(model)) it.wall_distance = wall_distance();
}

void Solver::Inside::close(State const& state)
{
    Closure& it = *closure;
    auto const mean = mean_velocity(state);
    auto const slopes = velocity_gradient(state, mean);
    auto const& set = settings.turbulence;
    auto const& thinning = settings.thinning;
    it.molecular = viscous;
    std::visit(
        [&](auto const& model) {
            using Law = std::decay_t<decltype(model)>;
            grid::for_each_cell(grid, [&](int i, int j, int k, Index c) {
                if (!grid.open(c)) return;
                turbulence::Local at{.width = it.width[c]};
                for (std::size_t d = 0; d < 3; ++d)
                    for (std::size_t e = 0; e < 3; ++e) at.slopes[d][e] = slopes[d][e][c];
                it.molecular[c] = law::viscosity::viscosity(
                    thinning.law,
                    {std::sqrt(at.strain2()), viscous[c], thinning.infinite, thinning.time, thinning.exponent});
                at.viscosity = it.molecular[c] / state.density[c];
                if constexpr (Law::transports) {
                    at.energy = state.energy_of_eddies[c], at.rate = state.rate_of_eddies[c];
                    if (!it.wall_distance.empty()) {
                        at.wall_distance = it.wall_distance[c];
                        std::array<int, 3> const cell{i, j, k};
                        for (std::size_t e = 0; e < 3; ++e) {
                            double const width = grid.axes[e].width(cell[e]);
                            at.crossing += slope_of(state.energy_of_eddies, e, c, width) *
                                           slope_of(state.rate_of_eddies, e, c, width);
                        }
                    }
                }
                double const eddy =
                    std::min(model(at), largest_ratio * at.viscosity) * left_by_granules(set, state.voidage[c]);
                it.eddy[c] = state.density[c] * eddy;
                if constexpr (Law::transports) {
                    auto const budget = model.budget(at, eddy);
                    it.made[c] = budget.made, it.lost[c] = budget.lost;
                    it.rate_made[c] = budget.rate_made, it.rate_lost[c] = budget.rate_lost;
                    auto const spread = model.spread(at);
                    it.spread_energy[c] = spread.energy, it.spread_rate[c] = spread.rate;
                }
            });
        },
        set.model);
    close_at_walls(state, mean);
    refresh({&it.molecular, &it.eddy});
    for (Index c = 0; c < viscous.size(); ++c) viscous[c] = it.molecular[c] + it.eddy[c];
}

void Solver::Inside::close_at_walls(State const& state, std::array<Field, 3> const& mean)
{
    Closure& it = *closure;
    auto const& set = settings.turbulence;
    auto const& wall_law = set.wall;
    double const edge = wall_law.edge();
    auto const speed_along = [&](WallPiece const& piece) {
        double squares = 0;
        for (std::size_t d = 0; d < 3; ++d)
            if (d != piece.e) {
                double const slip = mean[d][piece.cell] - settings.walls[piece.wall].velocity[d];
                squares += slip * slip;
            }
        return std::sqrt(squares);
    };
    std::visit(
        [&](auto const& model) {
            using Law = std::decay_t<decltype(model)>;
            for (std::size_t first = 0, end = 0; first < wall_pieces.size(); first = end) {
                Index const c = wall_pieces[first].cell;
                double const nu = it.molecular[c] / state.density[c];
                double areas = 0, made = 0, rate = 0, mixed = 0;
                for (end = first; end < wall_pieces.size() && wall_pieces[end].cell == c; ++end) {
                    auto const& piece = wall_pieces[end];
                    if (settings.walls[piece.wall].slip) continue;
                    double const speed = speed_along(piece), y = piece.distance;
                    if constexpr (std::is_same_v<Law, turbulence::Laminar>) {
                        auto const& thinning = settings.thinning;
                        it.wall_viscosity[end] = law::viscosity::viscosity(
                            thinning.law, {speed / y, viscosity(state.temperature[c]), thinning.infinite, thinning.time,
                                           thinning.exponent});
                        continue;
                    }
                    double place = 0;  // y+
                    if constexpr (Law::transports)
                        place = wall_law.friction_velocity(state.energy_of_eddies[c]) * y / nu;
                    else
                        place = wall_law.place(speed, y, nu, edge);
                    bool const in_log_layer = place > edge;
                    double const holds = in_log_layer ? nu * place / wall_law.velocity(place, edge) : nu;
                    it.wall_viscosity[end] = state.density[c] * holds;
                    if (settings.walls[piece.wall].temperature) {
                        double const conductivity =
                            settings.conductivity.value_or(material::conductivity(state.temperature[c]));
                        double const prandtl =
                            it.molecular[c] * material::heat_capacity(state.vapour_fraction[c]) / conductivity;
                        it.wall_heat[end] =
                            in_log_layer ? prandtl * place / wall_law.temperature(place, edge, prandtl, set.prandtl)
                                         : 1;
                    }
                    if constexpr (Law::transports) {
                        double const k = state.energy_of_eddies[c];
                        areas += piece.area;
                        rate += piece.area * model.at_wall(k, y, nu, wall_law.karman, in_log_layer);
                        double const friction_velocity = wall_law.friction_velocity(k);
                        if (in_log_layer)
                            made += piece.area * holds * speed / y * friction_velocity / (wall_law.karman * y);
                        else if (Law::resolves_walls)
                            made += piece.area * it.made[c];
                        // Across a log layer the slopes of the cell say nothing of those in its middle.
                        mixed +=
                            piece.area * (in_log_layer ? left_by_granules(set, state.voidage[c]) * state.density[c] *
                                                             wall_law.karman * friction_velocity * y
                                                       : it.eddy[c]);
                    }
                }
                if constexpr (Law::transports)
                    if (areas > 0)
                        it.fixed_rate[c] = rate / areas, it.made[c] = made / areas, it.eddy[c] = mixed / areas;
            }
        },
        set.model);
}

void Solver::Inside::add_eddies(Field& property, double per) const
{
    for (Index c = 0; c < property.size(); ++c)
        if (grid.open(c)) property[c] += gas_volume[c] / grid.open_volume[c] * closure->eddy[c] / per;
}

Field Solver::eddy_viscosity(State const& state) const
{
    Inside& in = *inside_;
    if (turbulence::is_laminar(in.settings.turbulence.model)) return {};
    for (Index c = 0; c < in.viscous.size(); ++c)
        in.viscous[c] = in.grid.open(c) ? in.viscosity(state.temperature[c]) : 0;
    in.close(state);
    Field out = in.closure->eddy;
    for (Index c = 0; c < out.size(); ++c)
        if (in.grid.open(c)) out[c] /= state.density[c];
    return out;
}
}
