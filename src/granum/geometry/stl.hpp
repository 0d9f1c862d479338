// Triangle meshes from STL files, ASCII and binary.
//
// Layout of the binary file: 80 bytes of comment, the number of triangles, then 50 bytes for each: normal, three
// corners, two unused bytes. Normals in the file are not used; the order of the corners gives them.
#pragma once

#include "granum/geometry/shape.hpp"

#include <cstddef>
#include <string>

namespace granum::geometry
{
struct StlOptions
{
    double scale = 1;                        //!< m per unit of length in the file: 1e-3 for millimetres
    Vec3 shift{};                            //!< added after scaling, m
    std::size_t most_triangles = 2'000'000;  //!< more are refused, of a binary file before it is read
    bool keep_flat = false;                  //!< triangles without area stay in the mesh
};

struct StlMesh
{
    Mesh mesh;
    std::size_t degenerate =
        0;  //!< triangles without area: lower than 1e-6 of the size of the mesh; left out if not to be kept
};

//! Reads a file, or throws base::IoError with its path, the line or number of the triangle, and what is wrong:
//! unreadable or not a file, neither ASCII nor binary STL, a size that does not fit the count, numbers that are not
//! finite, too many triangles, a mesh without area.
StlMesh read_stl(std::string const& path, StlOptions const& options = {});
}
