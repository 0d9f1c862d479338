#include "peers/state.hpp"

#include "granum/base/error.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <string>

namespace granum::peers
{
State read_state(std::filesystem::path const& path)
{
    std::ifstream file(path);
    if (!file) throw base::IoError(fmt::format("{}: cannot be read", path.string()));
    State state;
    std::string line;
    std::getline(file, line);
    if (std::sscanf(line.c_str(), "# lx=%lf ly=%lf rho=%lf", &state.length_x, &state.length_y, &state.density) != 3 ||
        !(state.length_x > 0 && state.length_y > 0 && state.density > 0))
        throw base::IoError(
            fmt::format("{}:1: \"{}\" is not of the form \"# lx=0.072 ly=0.036 rho=1500\"", path.string(), line));
    std::getline(file, line);
    for (long number = 3; std::getline(file, line); ++number) {
        long id = 0;
        std::array<double, 10> c{};
        if (std::sscanf(line.c_str(), "%ld,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &id, &c[0], &c[1], &c[2], &c[3],
                        &c[4], &c[5], &c[6], &c[7], &c[8], &c[9]) != 11 ||
            id != static_cast<long>(state.spheres.size()) + 1 || !(c[3] > 0))
            throw base::IoError(fmt::format("{}:{}: \"{}\" is not sphere {} as id,x,y,z,radius,vx,vy,vz,wx,wy,wz",
                                            path.string(), number, line, state.spheres.size() + 1));
        state.spheres.push_back({{c[0], c[1], c[2]}, c[3], {c[4], c[5], c[6]}, {c[7], c[8], c[9]}});
    }
    if (state.spheres.empty()) throw base::IoError(fmt::format("{}: holds no spheres", path.string()));
    return state;
}

void write_state(State const& state, std::filesystem::path const& path)
{
    std::ofstream file(path);
    file << fmt::format("# lx={} ly={} rho={}\n", state.length_x, state.length_y, state.density)
         << "id,x,y,z,radius,vx,vy,vz,wx,wy,wz\n";
    long id = 0;
    for (auto const& [x, r, v, w] : state.spheres)
        file << fmt::format("{},{:.9f},{:.9f},{:.9f},{:.9f},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", ++id, x.x,
                            x.y, x.z, r, v.x, v.y, v.z, w.x, w.y, w.z);
    if (!file.flush()) throw base::IoError(fmt::format("{}: cannot be written", path.string()));
}

Sphere in_tile(State const& state, Sphere sphere, long i, long j)
{
    // Spin is an axial vector: a mirror turns the components along it round and keeps the one across it.
    if (i % 2 != 0) {
        sphere.position.x = state.length_x - sphere.position.x;
        sphere.velocity.x *= -1, sphere.spin.y *= -1, sphere.spin.z *= -1;
    }
    if (j % 2 != 0) {
        sphere.position.y = state.length_y - sphere.position.y;
        sphere.velocity.y *= -1, sphere.spin.x *= -1, sphere.spin.z *= -1;
    }
    sphere.position.x += static_cast<double>(i) * state.length_x;
    sphere.position.y += static_cast<double>(j) * state.length_y;
    return sphere;
}
}
