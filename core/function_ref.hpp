#pragma once
// A reference to a callable: passed down without a copy or an allocation.

#include <memory>
#include <type_traits>
#include <utility>

namespace tread {

template <class Signature>
class FunctionRef;

/// Refers to a callable that outlives it, usually a lambda among the arguments of a call.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  template <class Callable>
  requires(!std::is_same_v<Callable, FunctionRef>) FunctionRef(const Callable& callable)
      : callable_(std::addressof(callable)), call_([](const void* object, Arguments... arguments) -> Result {
          return (*static_cast<const Callable*>(object))(std::forward<Arguments>(arguments)...);
        }) {}

  Result operator()(Arguments... arguments) const {
    return call_(callable_, std::forward<Arguments>(arguments)...);
  }

 private:
  const void* callable_;
  Result (*call_)(const void*, Arguments...);
};

}  // namespace tread
