#include "granum/geometry/stl_solid.hpp"

#include "granum/base/error.hpp"
#include "granum/geometry/closed_check.hpp"

#include <utility>

namespace granum::geometry
{
namespace
{
constexpr double too_different = 100;

StlMesh read(std::string const& path, StlOptions options)
{
    options.keep_flat = true;
    try {
        return read_stl(path, options);
    } catch (base::IoError const& error) {
        throw base::CaseError({{"", 0, "", error.what(), {}}});
    }
}

void check_size(std::string const& path, Mesh const& mesh, StlSolidOptions const& options)
{
    Bounds box;
    for (auto const& triangle : mesh.triangles)
        for (auto const& corner : triangle) box.widen(corner);
    double const size = box.size(), ratio = size / options.expected_size;
    if (options.expected_size <= 0 || (ratio <= too_different && ratio >= 1 / too_different)) return;
    std::string const what =
        fmt::format("is {:.4g} m large where the apparatus has {:.4g} m: {}", size, options.expected_size,
                    ratio > 1 ? "millimetres read as metres?" : "metres read as millimetres?");
    throw base::CaseError(
        {{path, 0, "", what, {fmt::format("one unit of the file was taken as {:g} m", options.stl.scale)}}});
}
}

StlSolid read_stl_solid(std::string const& path, StlSolidOptions const& options)
{
    auto const mesh = read(path, options.stl).mesh;
    check_size(path, mesh, options);
    auto check = inspect_closed(mesh.triangles);
    std::vector<base::Mistake> mistakes;
    for (auto& fault : check.faults) mistakes.push_back({path, 0, "", std::move(fault.what), {std::move(fault.hint)}});
    if (!mistakes.empty()) throw base::CaseError(std::move(mistakes));
    StlSolid out{std::make_shared<ClosedMesh const>(check.corners), {}};
    if (check.was_inside_out) out.notices.push_back(fmt::format("{}: was inside out and has been turned", path));
    return out;
}
}
