// Solids from STL files: closed meshes only, and a message for everything that is none.
#pragma once

#include "granum/geometry/closed_mesh.hpp"
#include "granum/geometry/stl.hpp"

#include <memory>
#include <string>
#include <vector>

namespace granum::geometry
{
struct StlSolidOptions
{
    StlOptions stl{};
    double expected_size = 0;  //!< of the apparatus, m; 0: not known
};

struct StlSolid
{
    std::shared_ptr<ClosedMesh const> mesh;
    std::vector<std::string> notices;  //!< what was mended
};

//! Reads a file, or throws base::CaseError with all that keeps it from being a solid, each with the place and the
//! likely fix: no STL file, too many facets, a size that is wrong by more than 100 times, or what inspect_closed finds.
//! A mesh that is inside out as a whole is turned.
StlSolid read_stl_solid(std::string const& path, StlSolidOptions const& options = {});
}
