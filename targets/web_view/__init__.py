"""The page of ``burnish view``: what it shows beside the picture, and its files.

The page is written in TypeScript (``*.ts``); what browsers load, ``*.js``, is made of that.
"""
