#ifndef ROLLGAIT_SERVER_RPC_GRPC_LOG_H_
#define ROLLGAIT_SERVER_RPC_GRPC_LOG_H_

namespace rollgait::server {

// From now on what gRPC itself has to say (a handshake that failed, say) goes to the log of this process, as event
// "grpc.said". Its errors are warnings here: most are a client's doing.
void LogWhatGrpcSays();

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_GRPC_LOG_H_
