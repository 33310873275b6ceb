#pragma once
#include <memory>
#include <type_traits>
#include <utility>

namespace vasa {

/// Something that can be called, by reference: for what a function is given to call while it runs. Unlike
/// std::function it allocates nothing, and it must not outlive what it refers to.
template <class Signature>
class FunctionRef;

template <class Returned, class... Arguments>
class FunctionRef<Returned(Arguments...)> {
 public:
  template <class Callable>
  requires std::is_invocable_r_v<Returned, Callable&, Arguments...> &&
      (!std::is_same_v<std::remove_cvref_t<Callable>, FunctionRef>)
          FunctionRef(Callable&& callable)  // NOLINT(google-explicit-constructor): callers write a lambda
      : called_(const_cast<void*>(static_cast<const void*>(std::addressof(callable)))),
        call_([](void* called, Arguments... arguments) -> Returned {
          return (*static_cast<std::remove_reference_t<Callable>*>(called))(
              std::forward<Arguments>(arguments)...);
        }) {}

  Returned operator()(Arguments... arguments) const {
    return call_(called_, std::forward<Arguments>(arguments)...);
  }

 private:
  void* called_;
  Returned (*call_)(void*, Arguments...);
};

}  // namespace vasa
