#include "granum/sim/box_output.hpp"

#include "granum/geometry/ball_in_box.hpp"

#include <fmt/format.h>

namespace granum::sim
{
namespace
{
//! The last one with gas only.
constexpr std::array<std::pair<char const*, char const*>, 6> columns_of_box{{{"solids_fraction", "1"},
                                                                             {"granules", "1"},
                                                                             {"velocity_x", "m/s"},
                                                                             {"velocity_y", "m/s"},
                                                                             {"velocity_z", "m/s"},
                                                                             {"gas_pressure", "Pa"}}};

std::array<double, columns_of_box.size()> row_of(BoxContent const& box)
{
    return {box.solids_fraction, box.granules, box.velocity.x, box.velocity.y, box.velocity.z, box.pressure};
}

//! Length that two intervals have in common.
double common(double a, double b, double c, double d)
{
    return std::max(0.0, std::min(b, d) - std::max(a, c));
}

//! Mean pressure of the gas in each box over the open cells that reach into it, Pa. Collective.
std::vector<double> pressures(Simulation& simulation)
{
    auto const& boxes = simulation.data().output.boxes;
    auto const& grid = simulation.grid();
    std::vector<base::ExactSum> sums(2 * boxes.size());
    grid::for_each_cell(grid, [&](int i, int j, int k, grid::Index c) {
        if (!grid.open(c)) return;
        std::array<int, 3> const cell{i, j, k};
        for (std::size_t b = 0; b < boxes.size(); ++b) {
            auto const& [lower, upper] = boxes[b].region;
            double volume = 1;
            for (std::size_t d = 0; d < 3; ++d)
                volume *= common(grid.axes[d].face(cell[d]), grid.axes[d].face(cell[d] + 1), lower[d], upper[d]);
            if (volume == 0) continue;
            sums[2 * b].add(volume * simulation.gas().pressure[c]);
            sums[2 * b + 1].add(volume);
        }
    });
    simulation.comm().sum(std::span(sums));
    std::vector<double> out(boxes.size());
    for (std::size_t b = 0; b < boxes.size(); ++b)
        if (double const volume = sums[2 * b + 1].value(); volume > 0) out[b] = sums[2 * b].value() / volume;
    return out;
}
}

std::vector<BoxContent> box_contents(Simulation& simulation)
{
    auto const& data = simulation.data();
    auto const& boxes = data.output.boxes;
    auto const& granules = simulation.granules();
    Vec3 const length = data.chamber.upper() - data.chamber.lower();
    std::vector<base::ExactSum> volume(boxes.size()), flow(3 * boxes.size());
    std::vector<double> inside(boxes.size());
    for (std::size_t b = 0; b < boxes.size(); ++b) {
        auto const& [lower, upper] = boxes[b].region;
        for (std::size_t row = 0; row < granules.owned; ++row) {
            Vec3 x = granules.position[row];
            double const radius = granules.radius[row];
            // Over a periodic face the image nearest to the middle of the box, and where both may reach in, both.
            std::array<double, 3> other{};
            bool in = true;
            for (std::size_t d = 0; d < 3; ++d) {
                if (data.periodic[d]) {
                    double const middle = 0.5 * (lower[d] + upper[d]);
                    x[d] -= length[d] * std::round((x[d] - middle) / length[d]);
                    other[d] = x[d] < middle ? length[d] : -length[d];
                }
                in = in && x[d] >= lower[d] && x[d] < upper[d];
            }
            inside[b] += in;
            for (int image = 0; image < 8; ++image) {
                Vec3 at = x;
                bool real = true;
                for (std::size_t d = 0; d < 3; ++d)
                    if ((image >> d & 1) != 0) {
                        real = real && other[d] != 0;
                        at[d] += other[d];
                    }
                if (!real) continue;
                double const part = geometry::ball_in_box(at, radius, lower, upper);
                if (part == 0) continue;
                volume[b].add(part);
                for (std::size_t d = 0; d < 3; ++d) flow[3 * b + d].add(part * granules.velocity[row][d]);
            }
        }
    }
    simulation.comm().sum(std::span(volume));
    simulation.comm().sum(std::span(flow));
    simulation.comm().sum(std::span(inside));
    std::vector<BoxContent> out;
    for (std::size_t b = 0; b < boxes.size(); ++b) {
        Vec3 const size = boxes[b].region.upper - boxes[b].region.lower;
        double const solids = volume[b].value();
        BoxContent content{solids / (size.x * size.y * size.z), inside[b], {}, 0};
        if (solids > 0)
            for (std::size_t d = 0; d < 3; ++d) content.velocity[d] = flow[3 * b + d].value() / solids;
        out.push_back(content);
    }
    if (!simulation.has_gas() || boxes.empty()) return out;
    auto const pressure = pressures(simulation);
    for (std::size_t b = 0; b < boxes.size(); ++b) out[b].pressure = pressure[b];
    return out;
}

BoxOutput::BoxOutput(std::string const& folder, Simulation& simulation) : simulation_(simulation)
{
    auto const& boxes = simulation.data().output.boxes;
    if (!simulation.comm().root() || boxes.empty()) return;
    std::vector<io::SeriesColumn> columns{{"time", "s"}};
    for (auto const& box : boxes)
        for (auto const& [what, unit] : std::span(columns_of_box).first(width()))
            columns.push_back({box.name + "_" + what, unit});
    table_ = {folder + "/boxes.csv", "boxes", columns};
}

std::size_t BoxOutput::width() const
{
    return columns_of_box.size() - (simulation_.has_gas() ? 0 : 1);
}

void BoxOutput::sample()
{
    last_ = box_contents(simulation_);
    if (!table_.writes()) return;
    std::vector<double> row{simulation_.time()};
    for (auto const& box : last_) {
        auto const numbers = row_of(box);
        row.insert(row.end(), numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(width()));
    }
    table_.append(row);
}

void BoxOutput::go_on(io::Sections const& saved)
{
    table_.go_on(saved);
    if (table_.rows() == 0) return;
    auto const row = table_.row(table_.rows() - 1);
    for (std::size_t b = 0; b < simulation_.data().output.boxes.size(); ++b) {
        auto const numbers = row.subspan(1 + width() * b, width());
        last_.push_back(
            {numbers[0], numbers[1], {numbers[2], numbers[3], numbers[4]}, simulation_.has_gas() ? numbers[5] : 0});
    }
}
}
