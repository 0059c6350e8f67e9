/* label.h - short texts for pictures, put together of words, names and numbers. */
#ifndef IL_OUTPUT_LABEL_H
#define IL_OUTPUT_LABEL_H

#include <stddef.h>

/* text: UTF-8, always terminated; what does not fit is left out. */
typedef struct il_label {
    char text[512];
    size_t n;
} il_label;

#define IL_LABEL_INIT { "", 0 }

void il_label_words(il_label *l, const char *words);
/* NAME is data: made printable, and cut with an ellipsis behind MOST columns. */
void il_label_name(il_label *l, const char *name, size_t most);
void il_label_count(il_label *l, size_t count);
/* "1 slice", "2 slices". */
void il_label_counted(il_label *l, size_t count, const char *noun);
/* V with at most DIGITS significant digits. */
void il_label_number(il_label *l, double v, int digits);
/* V with the decimals that tell it from others SPACING away, and one more; as it
 * is when that is shorter, and for a spacing of 0. */
void il_label_height(il_label *l, double v, double spacing);

/* How wide TEXT is about, in pixels, where the font is SIZE high: rather too
 * much than too little, for the font is not known. */
double il_label_width(const char *text, double size);

#endif
