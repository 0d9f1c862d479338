#include "granum/dem/kernel/kernel.hpp"

#include <vector>

namespace granum::dem::kernel
{
std::span<Kernel const* const> kernels()
{
    static std::vector<Kernel const*> const here = [] {
        std::vector<Kernel const*> out;
        bool const fma =
            __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
        if (fma && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
            __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
            __builtin_cpu_supports("avx512vl"))
            out.push_back(&avx512());
        if (fma) out.push_back(&avx2());
        if (__builtin_cpu_supports("sse4.2")) out.push_back(&sse4());
        out.push_back(&scalar());
        return out;
    }();
    return here;
}

Kernel const* find_kernel(std::string_view name)
{
    for (auto const* kernel : kernels())
        if (kernel->name == name) return kernel;
    return nullptr;
}
}
