// Audits in processes of their own: one solve at a time in a process, and a solver that dies takes no other with it.
#ifndef ROLLGAIT_BENCH_VERDICT_AUDIT_CHILDREN_H_
#define ROLLGAIT_BENCH_VERDICT_AUDIT_CHILDREN_H_

#include <functional>
#include <string>

namespace rollgait::audit {

// Calls work(i) for i in [0, count), each in a child process, `jobs` of them at a time, and done(i, text) in this one
// with what work returned, or with an empty text if the child died; in the order in which they end.
void RunInChildren(int count, int jobs, const std::function<std::string(int)>& work,
                   const std::function<void(int, const std::string&)>& done);

}  // namespace rollgait::audit

#endif  // ROLLGAIT_BENCH_VERDICT_AUDIT_CHILDREN_H_
