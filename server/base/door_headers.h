// What the door (docs/explanation/door.md) says in metadata of gRPC and headers of HTTP. It removes what a client
// itself sends under these names.
#ifndef ROLLGAIT_SERVER_BASE_DOOR_HEADERS_H_
#define ROLLGAIT_SERVER_BASE_DOOR_HEADERS_H_

namespace rollgait::server {

inline constexpr char kDoorPeer[] = "x-rollgait-peer";                       // "ipv4:192.0.2.1:4711"
inline constexpr char kDoorCertificate[] = "x-rollgait-client-certificate";  // verified; DER in base64; absent: none
// In an answer to the door, which counts it and takes it off: the caller showed nothing that the server knows.
inline constexpr char kDoorRefused[] = "x-rollgait-refused";

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_DOOR_HEADERS_H_
