#include "config.h"
#include "match/vessel.h"
#include "base/text.h"

#include <string.h>

/* Beginnings of words: veins and venous, arteries and arteriae, bronchus and bronchiole. */
static const char *const roots[] = { "airway", "aort", "arter", "bronch", "capillar", "carotid", "coronar", "jugular",
                                     "portal", "vascul", "vein", "vena", "venous", "venul", "vessel", NULL };

static bool is_lower(char c)
{
    return c >= 'a' && c <= 'z';
}

static bool is_upper(char c)
{
    return c >= 'A' && c <= 'Z';
}

/* Bytes of UTF-8 beyond ASCII are letters of some language. */
static bool is_letter(char c)
{
    return is_lower(c) || is_upper(c) || (unsigned char)c >= 0x80;
}

static bool begins_with_root(const char *word)
{
    for (size_t k = 0; roots[k]; k++) {
        size_t n = strlen(roots[k]);
        if (strlen(word) >= n && il_text_is_word(word, n, roots[k]))
            return true;
    }
    return false;
}

bool il_vessel_is_said(const char *text)
{
    for (const char *p = text; p && *p; p++) {
        bool begins = is_letter(*p) && (p == text || !is_letter(p[-1]) || (is_lower(p[-1]) && is_upper(*p)));
        if (begins && begins_with_root(p))
            return true;
    }
    return false;
}
