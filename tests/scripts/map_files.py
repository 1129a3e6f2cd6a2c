"""CGAL's map files, for tests: read by an XML reader that knows nothing of sesame, and counted by the oracle's maps."""

import xml.etree.ElementTree

import gmaps


class MapFile:
    """`links[k]`: of dart k, counted from 0, {i: dart}; `points`: {dart: (x, y, z)}."""

    def __init__(self, text):
        data = xml.etree.ElementTree.fromstring(text)
        assert data.tag == "data", data.tag
        darts = data.find("darts").findall("d")
        kinds = {link.tag for dart in darts for link in dart if link.tag in "ab"}
        assert len(kinds) < 2, kinds
        self.is_general = kinds == {"a"}
        self.links = []
        for dart in darts:
            links = [(int(link.get("i")), int(link.text) - 1) for link in dart if link.tag in "ab"]
            assert len(dict(links)) == len(links), links
            self.links.append(dict(links))
        self.points = {}
        for dimension in data.find("attributes").findall("dimension"):
            for attribute in dimension.findall("a"):
                point = attribute.find("p")
                if dimension.get("index") == "0" and point is not None:
                    dart = int(attribute.find("d").text) - 1
                    assert dart not in self.points
                    self.points[dart] = tuple(float(x.text) for x in point)
                    assert [x.tag for x in point] == ["x", "y", "z"]

    def alpha(self, dimension):
        """The involutions of the G-map, after a look at the laws."""
        size = len(self.links)
        if self.is_general:
            alpha = [[links.get(i, k) for k, links in enumerate(self.links)] for i in range(dimension + 1)]
        else:
            beta = [[links.get(i) for links in self.links] for i in range(1, dimension + 1)]
            assert gmaps.broken_law_of_nmap(beta) is None, gmaps.broken_law_of_nmap(beta)
            alpha = gmaps.gmap_of(beta)
            assert len(alpha[0]) == 2 * size
        assert gmaps.broken_law(alpha) is None, gmaps.broken_law(alpha)
        return alpha

    def cells(self, dimension):
        """How many cells it has in each dimension."""
        alpha = self.alpha(dimension)
        return [len(list(gmaps.orbits(alpha, gmaps.all_but(alpha, i)))) for i in range(dimension + 1)]

    def points_of_vertices(self, dimension):
        """The points by vertex, sorted."""
        alpha = self.alpha(dimension)
        vertices = [frozenset(orbit) for orbit in gmaps.orbits(alpha, gmaps.all_but(alpha, 0))]
        found = [[point for dart, point in self.points.items() if dart in vertex] for vertex in vertices]
        assert all(len(points) == 1 for points in found), found
        return sorted(points[0] for points in found)
