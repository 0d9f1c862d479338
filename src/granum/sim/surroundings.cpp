#include "granum/sim/surroundings.hpp"

#include "granum/material/moist_air.hpp"

#include <algorithm>
#include <cmath>

namespace granum::sim
{
using coupling::Mapping;
using grid::Index;
using math::Vec3;

DropletSurroundings::DropletSurroundings(grid::Grid const& grid, Mapping const& mapping,
                                         std::vector<spray::Nozzle> const& nozzles, par::Partition const& partition,
                                         int rank, double reach)
    : grid_(grid), mapping_(mapping), nozzles_(nozzles), partition_(partition), rank_(rank), reach_(reach)
{
    // The cells carry the jet once its half-width is one and a half cells (physics.md 4.1).
    double cell = 0;
    for (auto const& nozzle : nozzles) cell = std::max(cell, grid::widest_at(grid.lines, nozzle.position));
    jet_reach_ = 1.5 * cell / spray::Nozzle::half_width(1.0);
}

std::array<int, 3> DropletSurroundings::cell_of(Vec3 const& x) const
{
    std::array<int, 3> cell;
    for (std::size_t d = 0; d < 3; ++d) cell[d] = std::clamp(grid_.axes[d].cell(x[d]), 0, grid_.n[d] - 1);
    return cell;
}

void DropletSurroundings::prepare(gas::Solver const& solver, gas::State const& state, particle::Store const& granules,
                                  gas::Sources& sources, double dt, bool eddies)
{
    velocity_ = solver.cell_velocity(state);
    grid::Field* fields[] = {&velocity_[0], &velocity_[1], &velocity_[2]};
    mapping_.prepare(fields);
    if (eddies) {
        eddies_ = solver.eddies(state);
        grid::Field* more[] = {&eddies_->energy, &eddies_->dissipation, &eddies_->gradient[0], &eddies_->gradient[1],
                               &eddies_->gradient[2]};
        mapping_.prepare(more);
    }
    state_ = &state, sources_ = &sources, granules_ = &granules, dt_ = dt;
    // Counting sort of the granules by cell.
    first_.assign(grid_.size() + 1, 0);
    rows_.resize(granules.owned);
    std::vector<std::uint32_t> cell(granules.owned);
    for (std::size_t row = 0; row < granules.owned; ++row) {
        auto const [i, j, k] = cell_of(granules.position[row]);
        cell[row] = static_cast<std::uint32_t>(grid_.at(i, j, k));
        ++first_[cell[row] + 1];
    }
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    auto next = first_;
    // By identity within a cell, so that which granule a draw hits does not depend on the order in memory.
    for (std::uint32_t const row : mapping_.order()) rows_[next[cell[row]]++] = row;
}

spray::Seen DropletSurroundings::seen(Vec3 const& x) const
{
    auto const stencil = mapping_.stencil(x);
    spray::Seen seen;
    seen.gas_velocity = mapping_.gather(stencil, velocity_);
    if (eddies_) {
        seen.turbulent_energy = mapping_.gather(stencil, eddies_->energy);
        seen.dissipation = mapping_.gather(stencil, eddies_->dissipation);
        seen.energy_gradient = mapping_.gather(stencil, eddies_->gradient);
    }
    seen.temperature = mapping_.gather(stencil, state_->temperature);
    seen.vapour_fraction = mapping_.gather(stencil, state_->vapour_fraction);
    seen.density = mapping_.gather(stencil, state_->density);
    seen.viscosity = material::viscosity(seen.temperature);
    seen.solids_fraction = 1 - mapping_.gather(stencil, state_->voidage);
    for (auto const& nozzle : nozzles_) {
        if (math::norm(x - nozzle.position) > jet_reach_) continue;
        // The analytic jet is one in free gas: among granules (a tenth of solids) it is gone, and the cells have its
        // momentum.
        double const free = std::max(0.0, 1 - seen.solids_fraction / 0.1);
        double const jet = free * nozzle.jet_speed(x, seen.density);
        double const along = math::dot(seen.gas_velocity, nozzle.direction);
        if (jet > along) seen.gas_velocity += (jet - along) * nozzle.direction;
    }
    return seen;
}

void DropletSurroundings::give(Vec3 const& x, spray::Given const& given)
{
    auto const stencil = mapping_.stencil(x);
    mapping_.spread(stencil, given.vapour / dt_, sources_->mass);
    mapping_.spread(stencil, given.vapour / dt_, sources_->vapour);
    mapping_.spread(stencil, given.enthalpy / dt_, sources_->enthalpy);
    for (std::size_t d = 0; d < 3; ++d) mapping_.spread(stencil, given.momentum[d] / dt_, sources_->force[d]);
}

// Weights of a width of their own, for the density as for the choice: were they as wide as cells or parcels, so would
// be the layer of the bed that shares the spray, and with it how much is on each granule.
void DropletSurroundings::targets(Vec3 const& x, std::vector<spray::Target>& out) const
{
    out.clear();
    Vec3 const around{reach_, reach_, reach_};
    auto const first = cell_of(x - around), last = cell_of(x + around);
    // Part of the weights that lies in open cells of this rank: others have granules that it does not know.
    double seen = 0;
    for (int k = first[2]; k <= last[2]; ++k)
        for (int j = first[1]; j <= last[1]; ++j)
            for (int i = first[0]; i <= last[0]; ++i) {
                Index const cell = grid_.at(i, j, k);
                seen += share_of(0, i, x) * share_of(1, j, x) * share_of(2, k, x) * grid_.open_volume[cell] /
                        grid_.volume(i, j, k);
                for (std::uint32_t r = first_[cell]; r < first_[cell + 1]; ++r) {
                    std::size_t const row = rows_[r];
                    Vec3 const away = granules_->position[row] - x;
                    double density = granules_->count[row];
                    for (std::size_t d = 0; d < 3; ++d)
                        density *= std::max(0.0, 1 - std::abs(away[d]) / reach_) / reach_;
                    if (density > 0) out.push_back({row, density, granules_->velocity[row], granules_->diameter[row]});
                }
            }
    if (seen <= 0) out.clear();
    for (auto& target : out) target.chance /= seen;
}

double DropletSurroundings::share_of(std::size_t d, int cell, Vec3 const& x) const
{
    auto const below = [](double u) {
        double const inside = std::clamp(u, -1.0, 1.0);
        return inside < 0 ? 0.5 * (1 + inside) * (1 + inside) : 1 - 0.5 * (1 - inside) * (1 - inside);
    };
    auto const& axis = grid_.axes[d];
    return below((axis.face(cell + 1) - x[d]) / reach_) - below((axis.face(cell) - x[d]) / reach_);
}
}
