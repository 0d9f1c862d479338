#include "large_pages.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace granum::app
{
void use_large_pages(char** arguments)
{
    constexpr char const* variable = "GLIBC_TUNABLES";
    char const* before = std::getenv(variable);
    std::string tunables = before ? before : "";
    if (tunables.find("glibc.malloc.hugetlb") != std::string::npos) return;
    if (!tunables.empty()) tunables += ':';
    tunables += "glibc.malloc.hugetlb=1";
    std::error_code failed;
    auto const self = std::filesystem::read_symlink("/proc/self/exe", failed);  // keeps the program's name in lists
    if (failed || setenv(variable, tunables.c_str(), 1) != 0) return;
    execv(self.c_str(), arguments);
}
}
