// What the gas is like about a cell: means of its faces, slopes, spin, acceleration.
#include "granum/gas/inside.hpp"

namespace granum::gas
{
std::array<Field, 3> Solver::Inside::mean_velocity(State const& state) const
{
    std::array<Field, 3> means{grid.make_field(), grid.make_field(), grid.make_field()};
    for (std::size_t d = 0; d < 3; ++d) {
        auto const& u = state.velocity[d];
        for (auto const& run : cells)
            for (Index c = run.first; c < run.end; ++c) means[d][c] = 0.5 * (u[c] + u[next(c, d)]);
    }
    refresh({&means[0], &means[1], &means[2]});
    return means;
}
std::array<Field, 3> Solver::cell_velocity(State const& state) const
{
    return inside_->mean_velocity(state);
}

std::array<Field, 3> Solver::cell_pressure_gradient(State const& state) const
{
    Inside const& in = *inside_;
    FaceField slope = in.grid.make_face_field();
    for (std::size_t d = 0; d < 3; ++d)
        for (auto const& run : in.faces[d])
            for (Index q = run.first; q < run.end; ++q)
                slope[d][q] =
                    (state.pressure[q] - state.pressure[in.before(q, d)]) * in.per_gap[d][q] - in.stress[d][q];
    in.refresh({&slope[0], &slope[1], &slope[2]});
    std::array<Field, 3> means{in.grid.make_field(), in.grid.make_field(), in.grid.make_field()};
    for (std::size_t d = 0; d < 3; ++d)
        for (auto const& run : in.cells)
            for (Index c = run.first; c < run.end; ++c)
                means[d][c] = in.weights.lower[d][c] * slope[d][c] + in.weights.upper[d][c] * slope[d][in.next(c, d)];
    in.refresh({&means[0], &means[1], &means[2]});
    return means;
}

// A component along its own direction from the two faces; across from the means of the cells on both sides, at a wall
// that closes the face from the wall's velocity, or as if nothing changed where that slips.
Gradient Solver::Inside::velocity_gradient(State const& state, std::array<Field, 3> const& mean) const
{
    Gradient slope;
    for (std::size_t d = 0; d < 3; ++d)
        for (std::size_t e = 0; e < 3; ++e) {
            slope[d][e] = grid.make_field();
            if (repeats_itself(e)) continue;
            Field& to = slope[d][e];
            if (d == e) {
                grid::for_each_cell(grid, [&](int i, int j, int k, Index c) {
                    double const width = grid.axes[e].width(std::array{i, j, k}[e]);
                    if (grid.open(c)) to[c] = (state.velocity[d][next(c, e)] - state.velocity[d][c]) / width;
                });
                continue;
            }
            auto const value = [&](Index face, Index cell) {
                double const low = low_share[e][face];
                return solved[e][face] > 0 ? low * mean[d][before(face, e)] + (1 - low) * mean[d][face] : mean[d][cell];
            };
            grid::for_each_cell(grid, [&](int i, int j, int k, Index c) {
                double const width = grid.axes[e].width(std::array{i, j, k}[e]);
                if (grid.open(c)) to[c] = (value(next(c, e), c) - value(c, c)) / width;
            });
        }
    for (auto const& piece : wall_pieces) {
        Index const face = piece.upper ? next(piece.cell, piece.e) : piece.cell;
        auto const& wall = settings.walls[piece.wall];
        if (wall.slip || area[piece.e][face] > 0) continue;
        double const sign = piece.upper ? 1 : -1;
        for (std::size_t d = 0; d < 3; ++d)
            if (d != piece.e)
                slope[d][piece.e][piece.cell] += sign * (wall.velocity[d] - mean[d][piece.cell]) / (2 * piece.distance);
    }
    return slope;
}

double Solver::Inside::slope_of(Field const& x, std::size_t e, Index c, double width) const
{
    auto const at_face = [&](Index face) {
        double const low = low_share[e][face];
        return solved[e][face] > 0 ? low * x[before(face, e)] + (1 - low) * x[face] : x[c];
    };
    return repeats_itself(e) ? 0 : (at_face(next(c, e)) - at_face(c)) / width;
}

std::array<Field, 3> Solver::cell_vorticity(State const& state) const
{
    Inside const& in = *inside_;
    auto const slope = in.velocity_gradient(state, cell_velocity(state));
    std::array<Field, 3> curl{in.grid.make_field(), in.grid.make_field(), in.grid.make_field()};
    for (std::size_t d = 0; d < 3; ++d) {
        std::size_t const e = (d + 1) % 3, f = (d + 2) % 3;
        for (auto const& run : in.cells)
            for (Index c = run.first; c < run.end; ++c) curl[d][c] = slope[f][e][c] - slope[e][f][c];
    }
    in.refresh({&curl[0], &curl[1], &curl[2]});
    return curl;
}

std::array<Field, 3> Solver::cell_acceleration(State const& state) const
{
    Inside const& in = *inside_;
    auto const mean = cell_velocity(state);
    auto const slope = in.velocity_gradient(state, mean);
    std::array<Field, 3> rate{in.grid.make_field(), in.grid.make_field(), in.grid.make_field()};
    if (!(state.last_step > 0)) return rate;
    for (std::size_t d = 0; d < 3; ++d) {
        auto const& before = in.begun[d];
        for (auto const& run : in.cells)
            for (Index c = run.first; c < run.end; ++c)
                rate[d][c] = (mean[d][c] - 0.5 * (before[c] + before[in.next(c, d)])) / state.last_step +
                             mean[0][c] * slope[d][0][c] + mean[1][c] * slope[d][1][c] + mean[2][c] * slope[d][2][c];
    }
    in.refresh({&rate[0], &rate[1], &rate[2]});
    return rate;
}

// A couple m per volume acts as the force 1/2 curl m. With the means of m on open faces, what one cell gets over a face
// the other gets with the opposite sign.
void Solver::Inside::add_couples(std::array<Field, 3> const& couple, std::array<Field, 3>& force) const
{
    std::array<Field, 3> m = couple;
    for (Field& component : m)
        for (Index c = 0; c < component.size(); ++c)
            component[c] = grid.open(c) ? component[c] / grid.open_volume[c] : 0;
    refresh({&m[0], &m[1], &m[2]});
    for (std::size_t e = 0; e < 3; ++e) {
        if (repeats_itself(e)) continue;
        std::size_t const f = (e + 1) % 3, g = (e + 2) % 3;
        auto const through = [&](Index face, double sign, Index to) {
            if (solved[e][face] == 0) return;
            double const low = low_share[e][face], half_area = 0.5 * sign * area[e][face];
            auto const mean = [&](Field const& x) { return low * x[before(face, e)] + (1 - low) * x[face]; };
            // e x m = m_f g - m_g f, for the right-handed e, f, g.
            force[g][to] += half_area * mean(m[f]);
            force[f][to] -= half_area * mean(m[g]);
        };
        for (auto const& run : cells)
            for (Index c = run.first; c < run.end; ++c) {
                through(c, -1, c);
                through(next(c, e), 1, c);
            }
    }
}
}
