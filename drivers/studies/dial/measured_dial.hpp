#pragma once
// docs/dial/corrugation-d.jsonl, embedded at build time.

namespace tread {

extern const char* const kMeasuredDial;

}  // namespace tread
