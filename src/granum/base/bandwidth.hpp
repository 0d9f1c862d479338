// How fast this machine's memory is, as a yardstick for what a program makes of it.
#pragma once

#include "granum/base/aligned.hpp"

namespace granum::base
{
//! The triad a[i] = b[i] + s c[i] over arrays of 64 MB each, larger than caches. On large pages, as far as the system
//! gives them: the first touch of small ones takes the better part of a second on a virtual machine.
//! Source: McCalpin, STREAM.
class Triad
{
  public:
    Triad();
    //! bytes/s, counted at the 24 bytes an element that the program asks for: the best of three passes, some 20 ms.
    double rate();

  private:
    AlignedVector<double> a_, b_, c_;
};
}
