// One writer per folder: whoever holds the lock may write there; the system frees it when the process ends, however.
#pragma once

#include <string>

namespace granum::io
{
class FolderLock
{
  public:
    //! Takes the lock of `folder`, which exists; waits up to `patience` seconds for one who is just about to end.
    //! Throws base::IoError where somebody else goes on holding it.
    FolderLock(std::string const& folder, double patience);
    ~FolderLock();
    FolderLock(FolderLock const&) = delete;
    FolderLock& operator=(FolderLock const&) = delete;

  private:
    int file_ = -1;
};
}
