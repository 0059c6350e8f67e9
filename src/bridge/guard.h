/* guard.h - every bridge entry runs inside this: exceptions become codes. */
#ifndef IL_BRIDGE_GUARD_H
#define IL_BRIDGE_GUARD_H

extern "C" {
#include "base/status.h"
}

#include <CGAL/exceptions.h>
#include <exception>
#include <new>

template <class F> static il_status guarded(il_error *err, F &&f) noexcept
{
    try {
        return f();
    } catch (const std::bad_alloc &) {
        return il_fail_nomem(err);
    } catch (const CGAL::Failure_exception &e) {
        return il_fail(err, IL_E_INTERNAL, 0, "CGAL: %.200s", e.what());
    } catch (const std::exception &e) {
        return il_fail(err, IL_E_INTERNAL, 0, "%.200s", e.what());
    }
}

#endif
