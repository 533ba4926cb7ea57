#include "client/run_client.h"

int main(int argc, char** argv) {
  return rollgait::client::RunClient(argc, argv, rollgait::client::StandardTerminal());
}
