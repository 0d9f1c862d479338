// How many ranks this machine runs well.
#pragma once

namespace granum::app
{
//! Physical cores that this process may use; at least 1.
int cores();
}
