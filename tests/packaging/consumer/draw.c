#include <stdio.h>
#include <vtm/vtm.h>

int main(int count, char **arguments) {
    VtmRenderOptions options = {0};
    VtmPicture *picture = vtmLoadPicture(arguments[1]);
    VtmImage *image;
    int done;
    (void)count;
    options.width = 80;
    image = vtmRenderPicture(picture, &options);
    done = vtmSaveImage(image, arguments[2]);
    if (!done)
        fprintf(stderr, "%s\n", vtmGetError());
    vtmDestroyImage(image);
    vtmDestroyPicture(picture);
    return !done;
}
