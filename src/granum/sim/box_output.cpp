#include "granum/sim/box_output.hpp"

#include "granum/geometry/ball_in_box.hpp"

#include <fmt/format.h>

namespace granum::sim
{
std::vector<BoxContent> box_contents(Simulation& simulation)
{
    auto const& data = simulation.data();
    auto const& boxes = data.output.boxes;
    auto const& granules = simulation.granules();
    Vec3 const length = data.chamber.upper() - data.chamber.lower();
    std::vector<base::ExactSum> volume(boxes.size());
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
                if (real) volume[b].add(geometry::ball_in_box(at, radius, lower, upper));
            }
        }
    }
    simulation.comm().sum(std::span(volume));
    simulation.comm().sum(std::span(inside));
    std::vector<BoxContent> out;
    for (std::size_t b = 0; b < boxes.size(); ++b) {
        Vec3 const size = boxes[b].region.upper - boxes[b].region.lower;
        out.push_back({volume[b].value() / (size.x * size.y * size.z), inside[b]});
    }
    return out;
}

BoxOutput::BoxOutput(std::string const& folder, Simulation& simulation) : simulation_(simulation)
{
    auto const& boxes = simulation.data().output.boxes;
    if (!simulation.comm().root() || boxes.empty()) return;
    std::vector<io::SeriesColumn> columns{{"time", "s"}};
    for (auto const& box : boxes)
        for (auto const* what : {"solids_fraction", "granules"}) columns.push_back({box.name + "_" + what, "1"});
    file_ = std::make_unique<io::SeriesWriter>(folder + "/boxes.csv", columns);
}

std::string BoxOutput::head() const
{
    std::string out;
    for (auto const& [name, region] : simulation_.data().output.boxes)
        out += fmt::format("{} {} {} {} {} {} {}\n", name, region.lower.x, region.lower.y, region.lower.z,
                           region.upper.x, region.upper.y, region.upper.z);
    return out;
}

void BoxOutput::sample()
{
    last_ = box_contents(simulation_);
    if (!file_) return;
    std::vector<double> row{simulation_.time()};
    for (auto const& [solids, granules] : last_) row.insert(row.end(), {solids, granules});
    file_->append(row);
    rows_.insert(rows_.end(), row.begin(), row.end());
}

void BoxOutput::save(io::Sections& out) const
{
    auto const text = head();
    out.push_back(io::section_of("output.boxes.head", std::vector<char>(text.begin(), text.end())));
    out.push_back(io::section_of("output.boxes", rows_));
}

void BoxOutput::go_on(io::Sections const& saved)
{
    auto const was = io::values_of<char>(io::find_section(saved, "output.boxes.head"));
    if (!file_ || std::string(was.begin(), was.end()) != head()) return;
    rows_ = io::values_of<double>(io::find_section(saved, "output.boxes"));
    std::size_t const boxes = simulation_.data().output.boxes.size(), width = 1 + 2 * boxes;
    for (std::size_t at = 0; at + width <= rows_.size(); at += width)
        file_->append(std::span<double const>(rows_).subspan(at, width));
    if (rows_.size() < width) return;
    for (std::size_t b = 0; b < boxes; ++b) {
        auto const* const numbers = rows_.data() + rows_.size() - width + 1 + 2 * b;
        last_.push_back({numbers[0], numbers[1]});
    }
}
}
