#include "config.h"
#include "input/affine.h"

#include <math.h>

il_affine il_affine_multiply(const il_affine *o, const il_affine *i)
{
    return (il_affine){ o->a * i->a + o->c * i->b,        o->b * i->a + o->d * i->b,
                            o->a * i->c + o->c * i->d,        o->b * i->c + o->d * i->d,
                            o->a * i->e + o->c * i->f + o->e, o->b * i->e + o->d * i->f + o->f };
}

void il_affine_apply(const il_affine *m, double *x, double *y)
{
    double px = *x, py = *y;
    *x = m->a * px + m->c * py + m->e;
    *y = m->b * px + m->d * py + m->f;
}

/* The angle is brought into [-45, 45] first, which is exact in degrees; so
 * quarter turns keep coordinates bit for bit. */
void il_sincos_deg(double deg, double *sine, double *cosine)
{
    static const double degree = 3.14159265358979323846 / 180;
    double turn = fmod(deg, 360), quarter = floor(turn / 90 + 0.5), rest = turn - 90 * quarter;
    double s = sin(rest * degree), c = fabs(rest) == 45 ? fabs(s) : cos(rest * degree);
    switch (((int)quarter + 8) % 4) {
    case 0:  *sine = s,  *cosine = c;  break;
    case 1:  *sine = c,  *cosine = -s; break;
    case 2:  *sine = -s, *cosine = -c; break;
    default: *sine = -c, *cosine = s;  break;
    }
}
