#define GRANUM_KERNEL scalar_kernel
#define HWY_COMPILE_ONLY_SCALAR
#include "granum/dem/kernel/contact_loops.hpp"

namespace granum::dem::kernel
{
Kernel const& scalar()
{
    static constexpr Kernel kernel{"scalar", scalar_kernel::pairs, scalar_kernel::walls, scalar_kernel::move};
    return kernel;
}
}
