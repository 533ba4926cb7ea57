#ifndef ROLLGAIT_CLIENT_VIEW_HTTP_LIBRARY_H_
#define ROLLGAIT_CLIENT_VIEW_HTTP_LIBRARY_H_

// cpp-httplib, without a macro of <resolv.h> that it brings: Eigen has parameters of that name.
#include <httplib.h>
#undef _res

#endif  // ROLLGAIT_CLIENT_VIEW_HTTP_LIBRARY_H_
