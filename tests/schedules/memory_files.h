#ifndef ROLLGAIT_TESTS_SCHEDULES_MEMORY_FILES_H_
#define ROLLGAIT_TESTS_SCHEDULES_MEMORY_FILES_H_

namespace rollgait::server {

// Sets SQLite up for a process with one thread that opens databases again and again: its files, their locks and their
// shared memory are in the memory of the process (every file of the process, whatever its path), no mutex is taken, and
// freed memory stays with the process. What SQLite does is the same. Called before anything
// else of SQLite, and again without effect.
void KeepSqliteFilesInMemory();

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SCHEDULES_MEMORY_FILES_H_
