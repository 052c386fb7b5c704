#include "base/stop.h"

namespace regionmesh {
namespace {

thread_local const std::atomic<bool>* current = nullptr;

}  // namespace

StopScope::StopScope(const std::atomic<bool>* stop) : outer_(current) { current = stop; }
StopScope::~StopScope() { current = outer_; }

const std::atomic<bool>* stop_of_this_thread() { return current; }

}  // namespace regionmesh
