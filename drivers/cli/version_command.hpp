#pragma once
// `tread version` and `tread scene-reference`.

namespace tread {

/// Version, compiler, instruction sets and packages on stdout.
void print_version(bool json);

/// docs/scene.md on stdout, as JSON one member `markdown`.
void print_scene_reference(bool json);

}  // namespace tread
