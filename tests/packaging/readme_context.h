/* What README.md's code in C is about: a program that has its OpenVG context. */
#include <stdio.h>

#include <VG/openvg.h>
#include <VG/vgu.h>
#include <vtm/vtm.h>
