// Checkpoints of a run: numbered folders, each complete in itself, of which the newest valid one is taken.
//
// A checkpoint is written into 000417.tmp: one file of sections per rank, each synced; then the manifest with the seals
// of all files and, last, its own checksum; the folder is synced, renamed to 000417, and its parent synced. The
// manifest decides what is valid, never the rename. The last two and every tenth are kept; what goes is renamed to .old
// first, and whatever a killed run left of .tmp and .old is swept away at the start of the next.
#pragma once

#include "granum/io/sections.hpp"
#include "granum/par/communicator.hpp"

#include <optional>

namespace granum::io
{
//! What the manifest says of a checkpoint.
struct CheckpointLabel
{
    std::string program;          //!< version that wrote it
    std::uint64_t case_hash = 0;  //!< of the part of the case that shaped the state
    double time = 0;              //!< s
    long step = 0;
    int ranks = 0;  //!< that wrote it; set by `CheckpointFolder::write`
};

//! A valid checkpoint on the disk.
struct Checkpoint
{
    int number = 0;
    std::string folder;
    CheckpointLabel label;
    std::vector<Seal> seals;  //!< by the rank that wrote

    //! What rank `writer` wrote. Throws base::IoError where it is no longer as it was sealed.
    Sections read(int writer) const;
};

class CheckpointFolder
{
  public:
    //! `path` is made when the first checkpoint is written; its parent exists.
    CheckpointFolder(std::string path, par::Communicator const& comm, SystemCalls const& calls = SystemCalls::real());

    //! Removes what a killed run left half made. Collective.
    void sweep() const;

    //! Writes the next checkpoint and removes those no longer kept. Throws base::IoError, the same on every rank; the
    //! checkpoints before stay as they were. Collective. Returns its number.
    int write(CheckpointLabel label, Sections const& mine) const;

    //! The newest checkpoint whose every checksum holds; none if there is none. The reasons why newer ones were passed
    //! over are appended to `passed_over` on every rank. Collective.
    std::optional<Checkpoint> newest(std::vector<std::string>& passed_over) const;

    //! Removes all checkpoints. Collective.
    void clear() const;

  private:
    std::string write_mine(int number, Sections const& mine, Seal& seal) const;
    std::string finish(int number, CheckpointLabel const& label, std::vector<Seal> const& seals) const;
    void prune(int newest) const;

    std::string path_;
    par::Communicator const& comm_;
    SystemCalls const& calls_;
};

//! Manifest of the checkpoint folder `folder`, checked but for the files it names. Throws base::IoError.
Checkpoint read_manifest(std::string const& folder);
}
