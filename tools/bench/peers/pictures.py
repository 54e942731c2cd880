"""The pictures that are worked on: photographs that come with scikit-image, cut to size, as files of plain rows."""
import os

import cv2
import numpy as np


def fit(picture, w, h):
    scale = max(w / picture.shape[1], h / picture.shape[0])
    size = [int(np.ceil(side * scale)) for side in picture.shape[1::-1]]
    way = cv2.INTER_AREA if scale < 1 else cv2.INTER_CUBIC
    large = cv2.resize(np.ascontiguousarray(picture), size, interpolation=way)
    x, y = (large.shape[1] - w) // 2, (large.shape[0] - h) // 2
    return np.ascontiguousarray(large[y:y + h, x:x + w])


def tape_on_gravel(gravel, w, h):
    """A red tape on the floor in light that falls off to the left, with noise; and where the tape is."""
    tape = np.zeros((h, w), np.uint8)
    cv2.line(tape, (int(w * .35), h - 1), (int(w * .62), 0), 255, w // 16, cv2.LINE_AA)
    share = (tape / 255)[:, :, None]
    floor = cv2.cvtColor(gravel, cv2.COLOR_GRAY2BGR)
    red = np.array([40, 30, 200]) * (.5 + .5 * gravel[:, :, None] / 255)
    lit = (floor * (1 - share) + share * red) * np.linspace(.7, 1.1, w)[None, :, None]
    noise = np.random.default_rng(1).normal(0, 4, (h, w, 3))
    return np.clip(lit + noise, 0, 255).astype(np.uint8), tape


def depth(w, h):
    """Disparities of a scene in pixels: a floor that comes nearer, and a hill on it."""
    x, y = np.meshgrid(np.arange(w) / w, np.arange(h) / h)
    return (6 + 30 * y + 16 * np.exp(-((x - .6) ** 2 + (y - .4) ** 2) / .02)).astype(np.float32)


def pair(right, w, h):
    """What the left camera sees of that scene when the right one sees this picture."""
    x, y = np.meshgrid(np.arange(w, dtype=np.float32), np.arange(h, dtype=np.float32))
    left = cv2.remap(right, x - depth(w, h), y, cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE)
    noise = np.random.default_rng(2).normal(0, 1.5, (2, h, w))
    return [np.clip(side + n, 0, 255).round().astype(np.uint8) for side, n in zip((left, right), noise)]


def make(folder, w, h):
    from skimage import data
    coffee = fit(data.coffee()[:, :, ::-1], w, h)
    gray = cv2.cvtColor(coffee, cv2.COLOR_BGR2GRAY)
    coins = fit(data.coins(), w, h)
    smooth = cv2.GaussianBlur(coins, (5, 5), 0)
    line, tape = tape_on_gravel(fit(data.gravel(), w, h), w, h)
    pairs = cv2.cvtColor(coffee, cv2.COLOR_BGR2YUV_YUYV)
    masks = {
        "coins": cv2.threshold(smooth, 0, 255, cv2.THRESH_OTSU)[1],
        "page": cv2.threshold(fit(data.page(), w, h), 0, 255, cv2.THRESH_OTSU | cv2.THRESH_BINARY_INV)[1],
        "horse": fit((~data.horse()).astype(np.uint8) * 255, w, h) & 128,
        "edges": cv2.Canny(gray, 50, 150),
        "tape": tape & 128,
    }
    planes = cv2.cvtColor(coffee, cv2.COLOR_BGR2YUV_I420).ravel()
    chroma = planes[w * h:].reshape(2, -1).T
    yuyv, nv12 = np.zeros((h, w, 3), np.uint8), np.zeros((h, w, 3), np.uint8)
    yuyv.ravel()[:pairs.size] = pairs.ravel()
    nv12.ravel()[:chroma.size] = chroma.ravel()
    left, right = pair(cv2.addWeighted(gray, .6, fit(data.gravel(), w, h), .4, 0), w, h)
    seen = np.zeros((h, w, 3), np.uint8)
    seen.ravel()[:w * h] = right.ravel()
    os.makedirs(folder, exist_ok=True)
    pictures = {"coffee.gray": gray, "smooth_coins.gray": smooth, "coffee.color": coffee, "line.color": line,
                "yuyv.color": yuyv, "nv12.gray": planes[:w * h], "nv12.color": nv12,
                "pair.gray": left, "pair.color": seen}
    for name, rows in pictures.items():
        rows.tofile(os.path.join(folder, name))
    for name, rows in masks.items():
        words = np.zeros((h, (w + 31) // 32 * 4), np.uint8)
        bits = np.packbits(rows != 0, axis=1, bitorder="little")
        words[:, :bits.shape[1]] = bits
        words.tofile(os.path.join(folder, name + ".mask"))


def unpacked(words, w, h):
    """0 and 255 from the bits of a mask."""
    return np.unpackbits(words.reshape(h, -1), axis=1, bitorder="little")[:, :w] * np.uint8(255)


class Pictures:
    """Those of one row."""

    def __init__(self, folder, w, h, row):
        def read(kind):
            return np.fromfile(os.path.join(folder, row[kind] + "." + kind), np.uint8)
        self.w, self.h = w, h
        self.gray = read("gray").reshape(h, w) if row["gray"] != "-" else None
        self.color = read("color").reshape(h, w, 3) if row["color"] != "-" else None
        self.mask = np.ascontiguousarray(unpacked(read("mask"), w, h)) if row["mask"] != "-" else None
