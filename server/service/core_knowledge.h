#ifndef ROLLGAIT_SERVER_SERVICE_CORE_KNOWLEDGE_H_
#define ROLLGAIT_SERVER_SERVICE_CORE_KNOWLEDGE_H_

#include "server/service/gait_knowledge.h"

namespace rollgait::server {

// Requests as server/convert and core check them, models of the catalogue.
GaitKnowledge MakeCoreKnowledge();

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_CORE_KNOWLEDGE_H_
