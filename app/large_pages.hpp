// Large pages for all that the program allocates.
#pragma once

namespace granum::app
{
//! Starts this program again with glibc's allocator set to ask for large pages, unless the environment says something
//! about them already (GLIBC_TUNABLES, glibc.malloc.hugetlb; 0 keeps them off). Goes on with small pages where that
//! fails. The gas of the pilot example is solved in two thirds of the time: its fields are a few hundred kilobytes
//! each, so no allocator of single arrays helps, and where small pages lie in memory differs from run to run.
void use_large_pages(char** arguments);
}
