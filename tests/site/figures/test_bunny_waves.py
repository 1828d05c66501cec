"""The bunny's waves: the file that is made with the site, and the sums that the figure draws."""
import numpy as np
from hands import drag
from pages import waves
from reading import numbers, opened, settled, verdict

from course.given import mesh
from course.given.whose import Labs
from reference import regularization


def laplacian_of(faces, vertex_count):
    """L (V, V) with weights 1, and the masses: the valences (V,)."""
    edges, _ = mesh.edges(faces)
    L = regularization.laplacian(edges, np.ones(len(edges)), vertex_count)
    return L.toarray(), np.bincount(edges.ravel()).astype(float)


def test_the_file_has_the_bunnys_waves_slow_ones_first(page, address):
    """The browser reads rows as columns, or the waves are those of another mass."""
    page.goto(f"{address}/alias.html")
    found = page.evaluate("""async () => {
        const { unpacked, sumOfWaves } = await import("/figures/bunny_waves.js");
        const file = await (await fetch("/waves/bunny.bin")).arrayBuffer();
        const bunny = unpacked(file);
        return { size: file.byteLength, faces: bunny.faces, waves: [...bunny.waves],
                 vertices: [...sumOfWaves(bunny, bunny.count)] };
    }""")
    assert found["size"] < 300_000
    faces = np.array(found["faces"])
    vertices = np.reshape(found["vertices"], (-1, 3))
    rows = np.reshape(found["waves"], (len(vertices), len(vertices)))
    L, mass = laplacian_of(faces, len(vertices))
    mu = np.diag(rows @ L @ rows.T)
    assert len(faces) == 700 and len(mesh.boundary_edges(faces)) == 0
    assert (np.diff(mu) > -1e-3).all()
    np.testing.assert_allclose(rows @ (mass[:, None] * rows.T), np.eye(len(rows)), atol=2e-3)
    np.testing.assert_allclose(rows @ L, mu[:, None] * mass * rows, atol=2e-3)
    scanned = mesh.normalize(mesh.bunny()[0])
    size, wanted = (np.linalg.norm(x - x.mean(0), axis=1).max() for x in (vertices, scanned))
    assert np.isclose(size, wanted, rtol=0.1)


def small_surface():
    """A rough ball: its vertices (V, 3), masses (V,), waves (V, V) and their shares (V, 3)."""
    ball, faces = mesh.icosphere(80)
    vertices = ball * np.random.default_rng(13).uniform(0.5, 2, (len(ball), 1))
    found, shares = waves.waves_of(Labs("reference"), vertices, faces)
    return vertices, laplacian_of(faces, len(vertices))[1], found, shares


def test_the_sums_and_what_is_left_are_those_of_numpy(call, agrees):
    """One wave too many is added, or the squares lack their masses."""
    vertices, mass, found, shares = small_surface()
    surface = {"count": len(vertices), "waves": found.T.ravel(), "shares": shares.ravel()}
    counts = range(1, len(vertices) + 1)
    wanted = [found[:, :k] @ shares[:k] for k in counts]
    agrees("bunny_waves", "sumOfWaves", [(surface, k) for k in counts], wanted)
    np.testing.assert_allclose(wanted[-1], vertices, atol=1e-9)
    strengths, = call("bunny_waves", "strengths", [(surface,)])
    squares = ((np.array(wanted) - vertices) ** 2).sum(-1)
    agrees("bunny_waves", "distanceLeft", [(strengths, mass.sum(), k) for k in counts],
           np.sqrt(squares @ mass / mass.sum()))


def test_more_waves_come_nearer_to_the_bunny(page, address):
    """The handle does not choose the waves, or the sum is not drawn anew."""
    opened(page, address, "bunny_waves")
    page.get_by_text("19 of 352 waves").wait_for()
    handle = page.get_by_role("slider", name="Number of waves")
    handle.press("Home")
    assert "a point" in verdict(page) and clay(page) == 0
    handle.press("Shift+ArrowRight")
    assert "2 of 352" in settled(page).inner_text(".told")
    far = []
    for _ in range(12):
        far.append(numbers(settled(page).inner_text(".told"))[2])
        handle.press("Shift+ArrowRight")
    assert far == sorted(far, reverse=True) and far[0] > 20 and far[-1] == 0
    assert handle.get_attribute("aria-valuetext") == "352 waves" and clay(page) > 10_000


def clay(page):
    """How many pixels of the sum's picture are opaque?"""
    return page.evaluate("""() => {
        const canvas = document.querySelector(".sheet canvas");
        const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        return data.filter((value, n) => n % 4 === 3 && value === 255).length;
    }""")


def test_play_adds_waves_and_a_drag_stops_it(page, address):
    """Play and the reader pull at the same handle."""
    opened(page, address, "bunny_waves")
    page.get_by_text("19 of 352 waves").wait_for()
    page.get_by_role("button", name="Play").click()
    page.wait_for_function("parseInt(document.querySelector('.told b').innerText) > 100")
    drag(page, page.get_by_role("slider", name="Number of waves"), -150, 0)
    page.get_by_role("button", name="Play").wait_for()
    assert numbers(settled(page).inner_text(".told b"))[0] < 100


def test_a_reader_is_told_that_the_bunny_cannot_be_had(new_page, address):
    """The figure stays empty and says nothing."""
    page = new_page(missing="bunny.bin")
    page.route("**/bunny.bin", lambda route: route.abort())
    opened(page, address, "bunny_waves")
    page.get_by_text("could not be loaded").wait_for()
