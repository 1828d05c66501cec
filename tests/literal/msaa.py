"""Lab 4 as printed: what one types who has read the questions and the equations."""


def lattice(count, step):
    s = np.arange(count)
    r = step * (s + 1) % (count + 1) - 1
    return np.stack([(s + 0.5) / count, (r + 0.5) / count], -1)


def centre_sample(clip, offset, width, height):
    x, y, z, w = clip.T
    screen_x = (x / w + 1) * width / 2 + 0.5 - offset[0]
    screen_y = (y / w + 1) * height / 2 + 0.5 - offset[1]
    return np.stack([(screen_x * 2 / width - 1) * w, (screen_y * 2 / height - 1) * w, z, w], -1)


def coverage(face_index):
    return (face_index >= 0).mean(0)


def box_resolve(picture, n):
    height, width, channels = picture.shape
    result = np.zeros((height // n, width // n, channels))
    for i in range(n):
        for j in range(n):
            result += picture[i::n, j::n]
    return result / n**2


def shading_requests_loop(face_index):
    count, height, width = face_index.shape
    pixel, face = [], []
    request = np.full(face_index.shape, -1)
    for i in range(height):
        for j in range(width):
            seen = {}
            for s in range(count):
                f = face_index[s, i, j]
                if f >= 0:
                    if f not in seen:
                        seen[f] = len(pixel)
                        pixel.append(i * width + j)
                        face.append(f)
                    request[s, i, j] = seen[f]
    return np.array(pixel, int), np.array(face, int), request


def resolve(shade, request, background):
    colour = np.where((request >= 0)[..., None], shade[request], background)
    return colour.mean(0)


def resolve_backward(grad_picture, shade, request, background):
    grad_shade, grad_background = np.zeros(shade.shape), np.zeros(background.shape)
    for sample in request:
        np.add.at(grad_shade, sample[sample >= 0], grad_picture[sample >= 0] / len(request))
        grad_background += grad_picture[sample < 0].sum(0) / len(request)
    return grad_shade, grad_background
