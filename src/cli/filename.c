#include "config.h"
#include "cli/filename.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

static bool is_safe(char c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

/* The number that NAME begins with when a hyphen stands behind it, else 0. */
static uint32_t leading_number(const char *name)
{
    uint32_t n = 0;
    size_t k = 0;
    for (; name[k] >= '0' && name[k] <= '9' && k < 9; k++)
        n = 10 * n + (uint32_t)(name[k] - '0');
    return name[k] == '-' ? n : 0;
}

/* How often has NUMBER come, this time included?  USED holds that under
 * (NUMBER, 0).  A first "2-X" looks like a second "X": (NUMBER, 2) is put as
 * well then, and the second is called the third. */
static bool count_use(long number, const char *name, il_keymap *used, uint32_t *times)
{
    uint64_t key = (uint64_t)number;
    uint32_t count = il_keymap_get(used, key, 0, 0) + 1;
    while (count > 1 && il_keymap_get(used, key, count, 0))
        count++;
    uint32_t *place = il_keymap_put(used, key, 0, 0);
    if (!place)
        return false;
    *place = *times = count;
    uint32_t like = count == 1 ? leading_number(name) : 0;
    return like < 2 || il_keymap_put(used, key, like, 1);
}

bool il_filename_make(char *to, long number, const char *name, const char *extension, il_keymap *used)
{
    char safe[IL_FILENAME_NAME + 1], again[16] = "";
    uint32_t times;
    size_t n = 0;
    for (; name[n] && n < IL_FILENAME_NAME; n++)
        safe[n] = is_safe(name[n]) ? name[n] : '_';
    safe[n] = '\0';
    if (!count_use(number, safe, used, &times))
        return false;
    if (times > 1)
        snprintf(again, sizeof again, "-%lu", (unsigned long)times);
    snprintf(to, IL_FILENAME_MAX, "%04ld%s%s%s.%s", number, again, n > 0 ? "-" : "", safe, extension);
    return true;
}

const char *il_filename_extension(const char *path)
{
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
    const char *point = strrchr(base, '.');
    return point && point != base ? point + 1 : "";
}
