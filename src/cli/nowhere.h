/* nowhere.h - sinks that take everything and keep nothing, for runs that only look. */
#ifndef IL_CLI_NOWHERE_H
#define IL_CLI_NOWHERE_H

#include "model/mesh.h"
#include "model/sink.h"

/* They hold nothing, answer IL_OK to every call, and leave what they are given with
 * the caller. */
il_sink il_nowhere_contours(void);
il_mesh_sink il_nowhere_meshes(void);

#endif
