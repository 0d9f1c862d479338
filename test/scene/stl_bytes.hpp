// What a binary STL file holds, byte by byte.
#pragma once

#include "granum/geometry/shape.hpp"

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace granum::scene
{
inline std::string little_endian(std::uint32_t value)
{
    std::string out;
    for (int k = 0; k < 4; ++k) out += static_cast<char>((value >> (8 * k)) & 255);
    return out;
}

//! A binary file with these triangles.
inline std::string binary_stl(std::vector<geometry::Triangle> const& triangles, std::string comment = "made by a test")
{
    comment.resize(80, ' ');
    std::string out = comment + little_endian(static_cast<std::uint32_t>(triangles.size()));
    for (auto const& triangle : triangles) {
        out += std::string(12, '\0');
        for (auto const& corner : triangle)
            for (std::size_t d = 0; d < 3; ++d)
                out += little_endian(std::bit_cast<std::uint32_t>(static_cast<float>(corner[d])));
        out += std::string(2, '\0');
    }
    return out;
}
}
