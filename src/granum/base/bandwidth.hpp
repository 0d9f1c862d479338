// How fast this machine's memory is, as a yardstick for what a program makes of it.
#pragma once

namespace granum::base
{
//! Rate of a[i] = b[i] + s c[i] over arrays larger than caches, counted at the 24 bytes an element that the program
//! asks for, bytes/s: the best of three. Takes some tenths of a second. Source: McCalpin, STREAM (the triad).
double triad_rate();
}
