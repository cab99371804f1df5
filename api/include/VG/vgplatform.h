/*
 * OpenVG 1.1: primitive data types and macros for declarations (specification sections 3.2 and 19).
 * Plain C89. All functions are exported by libOpenVG.so.1, those of vgu.h too.
 */
#ifndef VTM_VG_VGPLATFORM_H
#define VTM_VG_VGPLATFORM_H

#ifndef VG_API_CALL
#define VG_API_CALL extern
#endif
#ifndef VGU_API_CALL
#define VGU_API_CALL extern
#endif
#ifndef VG_API_ENTRY
#define VG_API_ENTRY
#endif
#ifndef VG_API_EXIT
#define VG_API_EXIT
#endif
#ifndef VGU_API_ENTRY
#define VGU_API_ENTRY
#endif
#ifndef VGU_API_EXIT
#define VGU_API_EXIT
#endif

/* The names in the specification's own listing. */
#ifndef VG_APIENTRY
#define VG_APIENTRY VG_API_ENTRY
#endif
#ifndef VG_APIEXIT
#define VG_APIEXIT VG_API_EXIT
#endif
#ifndef VGU_APIENTRY
#define VGU_APIENTRY VGU_API_ENTRY
#endif
#ifndef VGU_APIEXIT
#define VGU_APIEXIT VGU_API_EXIT
#endif

typedef float VGfloat;
typedef signed char VGbyte;
typedef unsigned char VGubyte;
typedef signed short VGshort;
typedef signed int VGint;
typedef unsigned int VGuint;
typedef unsigned int VGbitfield;

/* Declares the functions of vgext.h, which are exported. */
#ifndef VG_VGEXT_PROTOTYPES
#define VG_VGEXT_PROTOTYPES
#endif

#endif
