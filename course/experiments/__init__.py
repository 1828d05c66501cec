"""What stands on the reference, or on your labs: `python3 -m course demo`.

    folder   the tool that makes a mesh of a folder of pictures: demo reconstruct FOLDER
    scenes   the other scenes of demo, one file each: its numbers and its pictures together
"""
