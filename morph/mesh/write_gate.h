#pragma once

namespace automorph {

/// While one exists, a file is being written aside, and end_when_files_are_whole() waits for it. Any number
/// may exist at once, on any thread.
class UnbrokenWrite {
public:
    UnbrokenWrite();
    ~UnbrokenWrite();
    UnbrokenWrite(const UnbrokenWrite&) = delete;
    UnbrokenWrite& operator=(const UnbrokenWrite&) = delete;
};

/// While one exists, end_when_files_are_whole() does not wait, but first calls undo(what): for files that
/// take too long to be waited for. A few may exist at once.
class UndoneAtEnd {
public:
    /// @param undo  only calls the system, as a signal handler may
    UndoneAtEnd(void (*undo)(void* what), void* what);
    ~UndoneAtEnd();
    UndoneAtEnd(const UndoneAtEnd&) = delete;
    UndoneAtEnd& operator=(const UndoneAtEnd&) = delete;

private:
    int slot_ = -1;
};

/// Calls `end`, which must end the process, at once if no file is being written, else on the thread that
/// finishes the last one. No further file is begun meanwhile once `end` has been called. Only takes atomics,
/// so that a signal handler may call it, on any thread.
void end_when_files_are_whole(void (*end)());

}  // namespace automorph
