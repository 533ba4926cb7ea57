#include "tests/schedules/memory_files.h"

#include <malloc.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "core/base/check.h"

namespace rollgait::server {
namespace {

constexpr int kShmLocks = SQLITE_SHM_NLOCK;

struct Handle;

// A file, with what its handles share as they would through the kernel.
struct MemoryFile {
  std::vector<char> bytes;
  std::vector<Handle*> handles;
  std::vector<std::unique_ptr<char[]>> regions;  // shared memory of the index of a write-ahead log
  std::array<int, kShmLocks> shared = {};        // holders
  std::array<const Handle*, kShmLocks> exclusive = {};
};

// What SQLite has of an open file.
struct Handle {
  sqlite3_file base;
  std::shared_ptr<MemoryFile> file;
  int level;        // SQLITE_LOCK_…
  unsigned shared;  // bits: locks of the shared memory
};

Handle& Of(sqlite3_file* file) { return *reinterpret_cast<Handle*>(file); }

std::map<std::string, std::shared_ptr<MemoryFile>>& Files() {
  static std::map<std::string, std::shared_ptr<MemoryFile>> files;
  return files;
}

int Close(sqlite3_file* base) {
  Handle& handle = Of(base);
  std::erase(handle.file->handles, &handle);
  handle.file.~shared_ptr();
  return SQLITE_OK;
}

int Read(sqlite3_file* base, void* to, int count, sqlite3_int64 at) {
  const std::vector<char>& bytes = Of(base).file->bytes;
  const auto start = std::min(static_cast<size_t>(at), bytes.size()), wanted = static_cast<size_t>(count);
  const size_t there = std::min(wanted, bytes.size() - start);
  if (there > 0) std::memcpy(to, bytes.data() + start, there);
  if (there == wanted) return SQLITE_OK;
  std::memset(static_cast<char*>(to) + there, 0, wanted - there);
  return SQLITE_IOERR_SHORT_READ;
}

int Write(sqlite3_file* base, const void* from, int count, sqlite3_int64 at) {
  std::vector<char>& bytes = Of(base).file->bytes;
  const auto start = static_cast<size_t>(at), size = static_cast<size_t>(count);
  if (bytes.size() < start + size) bytes.resize(start + size);
  std::memcpy(bytes.data() + start, from, size);
  return SQLITE_OK;
}

int Truncate(sqlite3_file* base, sqlite3_int64 size) {
  std::vector<char>& bytes = Of(base).file->bytes;
  bytes.resize(std::min(bytes.size(), static_cast<size_t>(size)));
  return SQLITE_OK;
}

int Sync(sqlite3_file*, int) { return SQLITE_OK; }  // processes die here, machines do not lose their power

int FileSize(sqlite3_file* base, sqlite3_int64* size) {
  *size = static_cast<sqlite3_int64>(Of(base).file->bytes.size());
  return SQLITE_OK;
}

// The highest level of the others.
int LevelBeside(const Handle& handle) {
  int highest = SQLITE_LOCK_NONE;
  for (const Handle* other : handle.file->handles) {
    if (other != &handle) highest = std::max(highest, other->level);
  }
  return highest;
}

int Lock(sqlite3_file* base, int level) {
  Handle& handle = Of(base);
  if (handle.level >= level) return SQLITE_OK;
  const int others = LevelBeside(handle);
  if (level == SQLITE_LOCK_SHARED && others >= SQLITE_LOCK_PENDING) return SQLITE_BUSY;
  if (level == SQLITE_LOCK_RESERVED && others >= SQLITE_LOCK_RESERVED) return SQLITE_BUSY;
  if (level == SQLITE_LOCK_EXCLUSIVE) {
    if (others >= SQLITE_LOCK_RESERVED) return SQLITE_BUSY;
    handle.level = SQLITE_LOCK_PENDING;  // kept where readers are in the way, so that no new one comes
    if (others >= SQLITE_LOCK_SHARED) return SQLITE_BUSY;
  }
  handle.level = level;
  return SQLITE_OK;
}

int Unlock(sqlite3_file* base, int level) {
  Of(base).level = std::min(Of(base).level, level);
  return SQLITE_OK;
}

int CheckReservedLock(sqlite3_file* base, int* held) {
  *held = std::max(Of(base).level, LevelBeside(Of(base))) >= SQLITE_LOCK_RESERVED ? 1 : 0;
  return SQLITE_OK;
}

int FileControl(sqlite3_file*, int, void*) { return SQLITE_NOTFOUND; }
int SectorSize(sqlite3_file*) { return 4096; }  // as of a disk, like the next
int DeviceCharacteristics(sqlite3_file*) { return SQLITE_IOCAP_POWERSAFE_OVERWRITE; }

int ShmMap(sqlite3_file* base, int region, int size, int extend, void volatile** memory) {
  auto& regions = Of(base).file->regions;
  const auto index = static_cast<size_t>(region);
  *memory = nullptr;
  if (index >= regions.size() && extend == 0) return SQLITE_OK;
  while (regions.size() <= index) regions.push_back(std::make_unique<char[]>(static_cast<size_t>(size)));
  *memory = regions[index].get();
  return SQLITE_OK;
}

int ShmLock(sqlite3_file* base, int offset, int count, int flags) {
  Handle& handle = Of(base);
  MemoryFile& file = *handle.file;
  const bool lock = (flags & SQLITE_SHM_LOCK) != 0, alone = (flags & SQLITE_SHM_EXCLUSIVE) != 0;
  const auto end = static_cast<size_t>(offset + count);
  for (auto i = static_cast<size_t>(offset); lock && i < end; ++i) {
    if (file.exclusive[i] != nullptr && file.exclusive[i] != &handle) return SQLITE_BUSY;
    const int others = file.shared[i] - static_cast<int>(handle.shared >> i & 1u);
    if (alone && others > 0) return SQLITE_BUSY;
  }
  for (auto i = static_cast<size_t>(offset); i < end; ++i) {
    const bool shares = (handle.shared >> i & 1u) != 0;
    if (alone) {
      if (lock || file.exclusive[i] == &handle) file.exclusive[i] = lock ? &handle : nullptr;
    } else if (lock != shares) {
      file.shared[i] += lock ? 1 : -1;
      handle.shared ^= 1u << i;
    }
  }
  return SQLITE_OK;
}

void ShmBarrier(sqlite3_file*) {}

int ShmUnmap(sqlite3_file* base, int remove) {
  ShmLock(base, 0, kShmLocks, SQLITE_SHM_UNLOCK | SQLITE_SHM_EXCLUSIVE);
  ShmLock(base, 0, kShmLocks, SQLITE_SHM_UNLOCK | SQLITE_SHM_SHARED);
  if (remove != 0) Of(base).file->regions.clear();
  return SQLITE_OK;
}

const sqlite3_io_methods kMethods = {
    .iVersion = 2,  // with shared memory
    .xClose = Close,
    .xRead = Read,
    .xWrite = Write,
    .xTruncate = Truncate,
    .xSync = Sync,
    .xFileSize = FileSize,
    .xLock = Lock,
    .xUnlock = Unlock,
    .xCheckReservedLock = CheckReservedLock,
    .xFileControl = FileControl,
    .xSectorSize = SectorSize,
    .xDeviceCharacteristics = DeviceCharacteristics,
    .xShmMap = ShmMap,
    .xShmLock = ShmLock,
    .xShmBarrier = ShmBarrier,
    .xShmUnmap = ShmUnmap,
    .xFetch = nullptr,
    .xUnfetch = nullptr,
};

// Without a name: a file that nobody else opens.
int Open(sqlite3_vfs*, const char* name, sqlite3_file* base, int flags, int* flags_used) {
  base->pMethods = nullptr;
  std::shared_ptr<MemoryFile> file;
  if (name == nullptr) {
    file = std::make_shared<MemoryFile>();
  } else {
    const auto place = Files().find(name);
    if (place == Files().end() && (flags & SQLITE_OPEN_CREATE) == 0) return SQLITE_CANTOPEN;
    file = place != Files().end() ? place->second : (Files()[name] = std::make_shared<MemoryFile>());
  }
  Handle* const handle = new (base) Handle{{&kMethods}, file, SQLITE_LOCK_NONE, 0};
  file->handles.push_back(handle);
  if (flags_used != nullptr) *flags_used = flags;
  return SQLITE_OK;
}

int Delete(sqlite3_vfs*, const char* name, int) {
  return Files().erase(name) != 0 ? SQLITE_OK : SQLITE_IOERR_DELETE_NOENT;
}

int Access(sqlite3_vfs*, const char* name, int, int* is_there) {
  *is_there = Files().count(name) != 0 ? 1 : 0;
  return SQLITE_OK;
}

int FullPathname(sqlite3_vfs*, const char* name, int size, char* full) {
  if (std::strlen(name) >= static_cast<size_t>(size)) return SQLITE_CANTOPEN;
  std::strcpy(full, name);
  return SQLITE_OK;
}

bool SetUp() {
  // A query with WITH RECURSIVE makes and frees a cache of pages; without these each is memory that the kernel takes
  // back and gives again.
  constexpr int kKeep = 1 << 30, kAhead = 16 << 20;
  mallopt(M_TRIM_THRESHOLD, kKeep);
  mallopt(M_MMAP_THRESHOLD, kKeep);
  mallopt(M_TOP_PAD, kAhead);
  ROLLGAIT_CHECK(sqlite3_config(SQLITE_CONFIG_SINGLETHREAD) == SQLITE_OK);
  ROLLGAIT_CHECK(sqlite3_config(SQLITE_CONFIG_MEMSTATUS, 0) == SQLITE_OK);
  // No pages beforehand: most of such a cache would stay empty.
  ROLLGAIT_CHECK(sqlite3_config(SQLITE_CONFIG_PAGECACHE, nullptr, 0, 0) == SQLITE_OK);
  static sqlite3_vfs files = *sqlite3_vfs_find(nullptr);  // its clock and random numbers stay
  files.zName = "memory-files";
  files.szOsFile = sizeof(Handle);
  files.pNext = nullptr;
  files.xOpen = Open;
  files.xDelete = Delete;
  files.xAccess = Access;
  files.xFullPathname = FullPathname;
  return sqlite3_vfs_register(&files, 1) == SQLITE_OK;
}

}  // namespace

void KeepSqliteFilesInMemory() {
  static const bool done = SetUp();
  ROLLGAIT_CHECK(done);
}

}  // namespace rollgait::server
