#include "granum/sim/probe_output.hpp"

#include "granum/material/moist_air.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace granum::sim
{
namespace air = material;

namespace
{
constexpr std::array<std::pair<char const*, char const*>, 8> columns_of_point{{{"velocity_x", "m/s"},
                                                                               {"velocity_y", "m/s"},
                                                                               {"velocity_z", "m/s"},
                                                                               {"temperature", "K"},
                                                                               {"humidity", "kg/kg"},
                                                                               {"drying_potential", "1"},
                                                                               {"pressure", "Pa"},
                                                                               {"voidage", "1"}}};
using Numbers = std::array<double, columns_of_point.size()>;

Numbers numbers_of(ProbeReading const& r)
{
    return {r.velocity.x, r.velocity.y,       r.velocity.z, r.temperature,
            r.humidity,   r.drying_potential, r.pressure,   r.voidage};
}

//! The cells before and behind x whose middles it lies between, by their number in the whole domain, and their shares.
struct Between
{
    std::array<int, 2> cell;
    std::array<double, 2> share;
};

Between between(std::vector<double> const& faces, double x, bool periodic)
{
    int const n = static_cast<int>(faces.size()) - 1;
    auto const middle = [&](int i) {
        auto const at = static_cast<std::size_t>(i);
        return 0.5 * (faces[at] + faces[at + 1]);
    };
    int const in = static_cast<int>(std::upper_bound(faces.begin() + 1, faces.end() - 1, x) - faces.begin()) - 1;
    int const other = x < middle(in) ? in - 1 : in + 1;
    if (other >= 0 && other < n) {
        double const share = (x - middle(in)) / (middle(other) - middle(in));
        return {{in, other}, {1 - share, share}};
    }
    if (!periodic || n < 2) return {{in, in}, {1, 0}};
    int const around = other < 0 ? n - 1 : 0;
    auto const width = [&](int i) {
        return faces[static_cast<std::size_t>(i) + 1] - faces[static_cast<std::size_t>(i)];
    };
    double const share = std::abs(x - middle(in)) / (0.5 * (width(in) + width(around)));
    return {{in, around}, {1 - share, share}};
}

template <class Visit>
void for_each_point(Case const& data, Visit&& visit)
{
    for (auto const& probe : data.output.probes)
        for (long k = 0; k < probe.points; ++k) visit(probe, k);
}
}

std::vector<ProbeReading> probe_readings(Simulation& simulation)
{
    auto const& grid = simulation.grid();
    auto const& gas = simulation.gas();
    auto const velocity = simulation.solver().cell_velocity(gas);
    constexpr std::size_t width = columns_of_point.size() + 1;  // the last: share of open cells
    std::vector<base::ExactSum> sums;
    for_each_point(simulation.data(), [&](ProbeCase const& probe, long k) {
        Vec3 const x = probe.at(k);
        std::array<Between, 3> around;
        for (std::size_t d = 0; d < 3; ++d) around[d] = between(grid.lines[d], x[d], grid.periodic[d]);
        std::size_t const first = sums.size();
        sums.resize(first + width);
        for (int corner = 0; corner < 8; ++corner) {
            std::array<int, 3> cell{};
            double share = 1;
            bool here = true;
            for (std::size_t d = 0; d < 3; ++d) {
                auto const side = static_cast<std::size_t>(corner >> d & 1);
                share *= around[d].share[side];
                cell[d] = around[d].cell[side] - grid.shift[d];
                here = here && cell[d] >= 0 && cell[d] < grid.n[d];
            }
            if (!here || share == 0) continue;
            auto const c = grid.at(cell);
            if (!grid.open(c)) continue;
            Numbers const values =
                numbers_of({{velocity[0][c], velocity[1][c], velocity[2][c]},
                            gas.temperature[c],
                            air::loading(gas.vapour_fraction[c]),
                            simulation.local_drying_potential(gas.temperature[c], gas.vapour_fraction[c]),
                            gas.pressure[c],
                            gas.voidage[c]});
            for (std::size_t v = 0; v < values.size(); ++v) sums[first + v].add(share * values[v]);
            sums[first + width - 1].add(share);
        }
    });
    simulation.comm().sum(std::span(sums));
    std::vector<ProbeReading> out;
    for (std::size_t at = 0; at < sums.size(); at += width) {
        double const share = sums[at + width - 1].value();
        auto const value = [&](std::size_t v) { return sums[at + v].value() / share; };
        out.push_back({{value(0), value(1), value(2)}, value(3), value(4), value(5), value(6), value(7)});
    }
    return out;
}

ProbeOutput::ProbeOutput(std::string const& folder, Simulation& simulation) : simulation_(simulation)
{
    if (!simulation.comm().root() || simulation.data().output.probes.empty()) return;
    std::vector<io::SeriesColumn> columns{{"time", "s"}};
    for_each_point(simulation.data(), [&](ProbeCase const& probe, long k) {
        for (auto const& [what, unit] : columns_of_point) columns.push_back({probe.label(k) + "_" + what, unit});
    });
    table_ = {folder + "/probes.csv", "probes", columns};
}

void ProbeOutput::sample()
{
    if (simulation_.data().output.probes.empty()) return;
    auto const readings = probe_readings(simulation_);
    if (!table_.writes()) return;
    std::vector<double> row{simulation_.time()};
    for (auto const& reading : readings) {
        auto const numbers = numbers_of(reading);
        row.insert(row.end(), numbers.begin(), numbers.end());
    }
    table_.append(row);
}

nlohmann::json ProbeOutput::summary(double start) const
{
    nlohmann::json out;
    std::size_t column = 1;
    for (auto const& probe : simulation_.data().output.probes) {
        nlohmann::json one{{"name", probe.name}};
        for (long k = 0; k < probe.points; ++k) {
            Vec3 const x = probe.at(k);
            one["position_m"].push_back({x.x, x.y, x.z});
            for (auto const& [what, unit] : columns_of_point) {
                double sum = 0, squares = 0, rows = 0;
                for (std::size_t r = 0; r < table_.rows(); ++r) {
                    if (table_.row(r)[0] < start) continue;
                    sum += table_.row(r)[column];
                    ++rows;
                }
                double const mean = sum / rows;
                for (std::size_t r = 0; r < table_.rows(); ++r)
                    if (table_.row(r)[0] >= start)
                        squares += (table_.row(r)[column] - mean) * (table_.row(r)[column] - mean);
                one[what]["mean"].push_back(mean);
                one[what]["deviation"].push_back(std::sqrt(squares / rows));
                ++column;
            }
        }
        out.push_back(std::move(one));
    }
    return out;
}
}
